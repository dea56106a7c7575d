//! The window as a screen reader sees it: through AT-SPI, on a D-Bus session of its own; and without any.

use crate::driven::Window;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use zbus::zvariant::{OwnedObjectPath, Value};

/// Limit for an element to appear. It only ends tests on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);
/// AT-SPI's numbers of roles.
const PAGE_TAB: u32 = 37;
const BUTTON: u32 = 43;
const TOGGLE_BUTTON: u32 = 62;
/// AT-SPI's number of the state of a toggle button that is on.
const PRESSED: u32 = 20;

/// A D-Bus session, which ends when this is dropped, with the accessibility services that it has started.
struct Session {
    daemon: Child,
    address: String,
}

impl Session {
    fn new() -> Session {
        let mut daemon = Command::new("dbus-daemon")
            .args(["--session", "--nofork", "--nopidfile", "--print-address"])
            .stdout(Stdio::piped())
            .spawn()
            .unwrap_or_else(|e| panic!("dbus-daemon: {e}; apt-get install dbus-daemon at-spi2-core"));
        let mut address = String::new();
        BufReader::new(daemon.stdout.take().unwrap()).read_line(&mut address).unwrap();
        Session { daemon, address: address.trim().to_owned() }
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        let _ = self.daemon.kill();
        let _ = self.daemon.wait();
    }
}

/// An element of the accessibility tree: the program's name on the bus, and a path.
type Element = (String, OwnedObjectPath);

/// A client of the accessibility bus, as a screen reader is one.
struct Reader(zbus::Connection);

impl Reader {
    /// Connects, and tells programs that a screen reader is there.
    async fn start(session: &Session) -> zbus::Result<Reader> {
        let connection = zbus::connection::Builder::address(session.address.as_str())?.build().await?;
        let bus = Some("org.a11y.Bus");
        let address: String =
            connection.call_method(bus, "/org/a11y/bus", bus, "GetAddress", &()).await?.body().deserialize()?;
        let enabled = ("org.a11y.Status", "IsEnabled", Value::from(true));
        connection.call_method(bus, "/org/a11y/bus", Some("org.freedesktop.DBus.Properties"), "Set", &enabled).await?;
        Ok(Reader(zbus::connection::Builder::address(address.as_str())?.build().await?))
    }

    async fn ask<T: serde::de::DeserializeOwned + zbus::zvariant::Type>(
        &self,
        (program, path): &Element,
        interface: &str,
        method: &str,
        arguments: &(impl serde::Serialize + zbus::zvariant::DynamicType),
    ) -> zbus::Result<T> {
        let interface = format!("org.a11y.atspi.{interface}");
        let answer =
            self.0.call_method(Some(program.as_str()), path, Some(interface.as_str()), method, arguments).await?;
        answer.body().deserialize()
    }

    async fn name(&self, (program, path): &Element) -> zbus::Result<String> {
        let asked = ("org.a11y.atspi.Accessible", "Name");
        let properties = Some("org.freedesktop.DBus.Properties");
        let answer = self.0.call_method(Some(program.as_str()), path, properties, "Get", &asked).await?;
        let value: zbus::zvariant::OwnedValue = answer.body().deserialize()?;
        Ok(String::try_from(value)?)
    }

    /// All elements of all programs: role, name and address. Elements that vanish meanwhile are left out.
    async fn elements(&self) -> Vec<(u32, String, Element)> {
        let root = OwnedObjectPath::try_from("/org/a11y/atspi/accessible/root").unwrap();
        let mut open: Vec<Element> = vec![("org.a11y.atspi.Registry".to_owned(), root)];
        let mut found = Vec::new();
        while let Some(element) = open.pop() {
            open.extend(self.ask::<Vec<Element>>(&element, "Accessible", "GetChildren", &()).await.unwrap_or_default());
            let role = self.ask::<u32>(&element, "Accessible", "GetRole", &()).await;
            if let (Ok(role), Ok(name)) = (role, self.name(&element).await) {
                found.push((role, name, element));
            }
        }
        found
    }

    /// The element with this role and name, as soon as it exists.
    async fn find(&self, role: u32, name: &str) -> Element {
        let start = Instant::now();
        loop {
            let elements = self.elements().await;
            if let Some((.., element)) = elements.iter().find(|(r, n, _)| *r == role && n == name) {
                return element.clone();
            }
            let seen: Vec<_> = elements.iter().map(|(role, name, _)| format!("{role} `{name}`")).collect();
            assert!(start.elapsed() < PATIENCE, "no role {role} `{name}` among {}", seen.join(", "));
            std::thread::sleep(Duration::from_millis(200));
        }
    }

    /// Does the first action of an element: a click.
    async fn act(&self, element: &Element) {
        assert!(self.ask::<bool>(element, "Action", "DoAction", &(0_i32)).await.unwrap());
    }

    async fn is_pressed(&self, element: &Element) -> bool {
        let states: Vec<u32> = self.ask(element, "Accessible", "GetState", &()).await.unwrap();
        states[0] & (1 << PRESSED) != 0
    }
}

#[test]
fn a_screen_reader_finds_and_presses_controls() {
    let session = Session::new();
    async_io::block_on(async {
        let reader = Reader::start(&session).await.unwrap_or_else(|e| panic!("{e}; apt-get install at-spi2-core"));
        let set = |command: &mut Command| _ = command.env("DBUS_SESSION_BUS_ADDRESS", &session.address);
        let mut window = Window::open_with(1280, 800, &["builtin:cube"], set);
        reader.find(BUTTON, "Open a model or a scene (Ctrl + O)").await;
        let tab = reader.find(PAGE_TAB, "Probe").await;
        reader.act(&tab).await;
        window.wait("the tab", |s| s["tab"] == "Probe");
        let lights = reader.find(PAGE_TAB, "Lights").await;
        reader.act(&lights).await;
        window.wait("the other tab", |s| s["tab"] == "Lights");
        let term = reader.find(TOGGLE_BUTTON, "diffuse term").await;
        assert!(reader.is_pressed(&term).await);
        reader.act(&term).await;
        window.wait("the term to be off", |s| s["scene"]["equation"]["diffuse"] == false);
        window.rest();
        assert!(!reader.is_pressed(&term).await);
    });
}

#[test]
fn a_window_without_a_session_says_nothing_about_it() {
    let folder = tempfile::tempdir().unwrap();
    let errors = folder.path().join("stderr.txt");
    let file = std::fs::File::create(&errors).unwrap();
    let set = |command: &mut Command| {
        command.env("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nonexistent/bus").stderr(file);
    };
    let mut window = Window::open_with(1024, 640, &["builtin:cube"], set);
    window.click("tab-probe");
    window.wait("the tab", |s| s["tab"] == "Probe");
    window.rest();
    assert_eq!(std::fs::read_to_string(&errors).unwrap(), "");
}
