//! Whether a window can be shown, and errors that explain why not.

/// The window's counterpart that needs none of this.
const INSTEAD: &str = "`gonio render` draws without a window";

/// Whether there is a display at all: always but on Linux and the like.
pub fn has_display() -> bool {
    !cfg!(all(unix, not(target_os = "macos"))) || is_set("WAYLAND_DISPLAY") || is_set("DISPLAY")
}

fn is_set(name: &str) -> bool {
    std::env::var_os(name).is_some_and(|value| !value.is_empty())
}

/// Everything whose lack would otherwise end in a panic or in words that do not help. An error is one sentence.
pub fn check() -> Result<(), String> {
    if !has_display() {
        return Err(format!("there is no display: neither WAYLAND_DISPLAY nor DISPLAY is set; {INSTEAD}"));
    }
    check_libraries()
}

#[cfg(target_os = "linux")]
fn check_libraries() -> Result<(), String> {
    let lacks = |library: &str, package: &str| {
        format!(
            "the window needs {library}, which is not installed: on Debian and Ubuntu, run `apt-get install {package}`"
        )
    };
    if xkbcommon_dl::xkbcommon_option().is_none() {
        return Err(lacks("libxkbcommon.so.0", "libxkbcommon0"));
    }
    // winit takes Wayland first, and does without X11's part then.
    if !is_set("WAYLAND_DISPLAY") && xkbcommon_dl::x11::xkbcommon_x11_option().is_none() {
        return Err(lacks("libxkbcommon-x11.so.0", "libxkbcommon-x11-0"));
    }
    Ok(())
}

#[cfg(not(target_os = "linux"))]
fn check_libraries() -> Result<(), String> {
    Ok(())
}

/// An error of eframe as one sentence.
pub fn sentence(why: eframe::Error) -> String {
    let packages =
        "on Debian and Ubuntu: apt-get install libgl1-mesa-dri libegl1 libxcursor1 libxi6 libxkbcommon-x11-0";
    let words = why.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
    match why {
        eframe::Error::AppCreation(_) => format!("the window could not be opened: {words}"),
        eframe::Error::Glutin(_) | eframe::Error::NoGlutinConfigs(..) | eframe::Error::OpenGL(_) => {
            format!("the window has no OpenGL ({words}); {packages}; {INSTEAD}")
        }
        _ => {
            format!("the display cannot be reached ({words}); check DISPLAY or WAYLAND_DISPLAY, {packages}; {INSTEAD}")
        }
    }
}
