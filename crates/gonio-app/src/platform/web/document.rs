//! Browser functions: file dialog, downloads, address, storage.

use gonio_language::tr;
use js_sys::{Array, Function, Promise, Uint8Array};
use std::cell::RefCell;
use std::time::Duration;
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{Blob, Document, File, HtmlAnchorElement, HtmlInputElement, Storage, Url, Window};

/// Key of the settings in the storage.
const KEY: &str = "gonio";
/// Prefix of the keys of drafts.
const DRAFT: &str = "gonio draft ";
/// A window may leave several texts of one file: KEY, KEY-2 and so on.
const MOST_OF_ONE_FILE: usize = 9;

/// A chosen or dropped file that has not been read yet.
pub struct NamedFile {
    /// Its name without folders, or with those below a chosen folder.
    pub name: String,
    file: UnreadFile,
}

/// A file of the file dialog or of a drop.
enum UnreadFile {
    Chosen(File),
    Dropped(egui::DroppedFileHandle),
}

impl NamedFile {
    /// A file dropped on the canvas.
    pub fn dropped(file: egui::DroppedFileHandle) -> Self {
        NamedFile { name: file.path().to_string_lossy().into_owned(), file: UnreadFile::Dropped(file) }
    }

    /// Reads it. An error is the browser's message.
    pub async fn bytes(self) -> Result<Vec<u8>, String> {
        match self.file {
            UnreadFile::Dropped(file) => file.bytes_async().await,
            UnreadFile::Chosen(file) => {
                let buffer = wasm_bindgen_futures::JsFuture::from(file.array_buffer()).await.map_err(words)?;
                Ok(Uint8Array::new(&buffer).to_vec())
            }
        }
    }
}

fn words(error: JsValue) -> String {
    error.as_string().unwrap_or_else(|| format!("{error:?}"))
}

fn window() -> Result<(Window, Document), String> {
    let window = web_sys::window().ok_or(tr!("window-the-page-has-no-window"))?;
    let document = window.document().ok_or(tr!("window-the-page-has-no-window"))?;
    Ok((window, document))
}

/// A parameter of the page's address, as it is written there.
pub fn parameter(name: &str) -> Option<String> {
    let (window, _) = window().ok()?;
    let search = window.location().search().ok()?;
    let mut parameters = search.trim_start_matches('?').split('&').filter_map(|parameter| parameter.split_once('='));
    parameters.find(|(known, _)| *known == name).map(|(_, value)| value.to_owned())
}

/// The languages that the user prefers, as tags, the most preferred first.
pub fn languages() -> Vec<String> {
    let Ok((window, _)) = window() else { return Vec::new() };
    window.navigator().languages().iter().filter_map(|tag| tag.as_string()).collect()
}

/// Declares the language of the page, which screen readers speak.
pub fn set_language(code: &str) {
    if let Some(element) = window().ok().and_then(|(_, document)| document.document_element()) {
        // An attribute with a valid name can be set.
        let _ = element.set_attribute("lang", code);
    }
}

/// Waits until the browser requests the next frame, and then for `more`. Returns at once if the browser does not support that.
pub async fn frame_shown(more: Duration) {
    let Ok((window, _)) = window() else { return };
    let milliseconds = i32::try_from(more.as_millis()).unwrap_or(i32::MAX);
    let frame = |resolve: &Function| window.request_animation_frame(resolve);
    let timer =
        |resolve: &Function| window.set_timeout_with_callback_and_timeout_and_arguments_0(resolve, milliseconds);
    for begin in [&frame as &dyn Fn(&Function) -> Result<i32, JsValue>, &timer] {
        let promise = Promise::new(&mut |resolve, _| {
            // A timer that could not be started is not waited for.
            if begin(&resolve).is_err() {
                let _ = resolve.call0(&JsValue::NULL);
            }
        });
        let _ = wasm_bindgen_futures::JsFuture::from(promise).await;
    }
}

thread_local! {
    // The callback of the last dialog, which the browser calls after `choose` has returned.
    static CHOICE: RefCell<Option<Closure<dyn FnMut()>>> = const { RefCell::new(None) };
}

/// Shows the browser's file dialog. An error is one sentence.
pub fn choose(answer: impl Fn(Vec<NamedFile>) + 'static) -> Result<(), String> {
    let failed = |_| tr!("window-the-browser-does-not-allow-choosing").to_owned();
    let (_, document) = window()?;
    let input: HtmlInputElement =
        document.create_element("input").map_err(failed)?.dyn_into().map_err(|e| failed(e.into()))?;
    input.set_type("file");
    input.set_multiple(true);
    let chosen = input.clone();
    let closure = Closure::<dyn FnMut()>::new(move || {
        let Some(list) = chosen.files() else { return };
        let files: Vec<NamedFile> = (0..list.length())
            .filter_map(|index| list.get(index))
            .map(|file| NamedFile { name: file.name(), file: UnreadFile::Chosen(file) })
            .collect();
        if !files.is_empty() {
            answer(files);
        }
    });
    input.set_onchange(Some(closure.as_ref().unchecked_ref()));
    CHOICE.with(|choice| *choice.borrow_mut() = Some(closure));
    input.click();
    Ok(())
}

/// Downloads a file. An error is one sentence.
pub fn download(name: &str, bytes: &[u8]) -> Result<(), String> {
    let failed = |error: JsValue| tr!("window-could-not-be-downloaded", name = name, error = words(error));
    let (_, document) = window()?;
    let blob = Blob::new_with_u8_array_sequence(&Array::of1(&Uint8Array::from(bytes))).map_err(failed)?;
    let url = Url::create_object_url_with_blob(&blob).map_err(failed)?;
    let anchor: HtmlAnchorElement =
        document.create_element("a").map_err(failed)?.dyn_into().map_err(|e| failed(e.into()))?;
    anchor.set_href(&url);
    anchor.set_download(name);
    anchor.click();
    // The download has started, and keeps its data.
    Url::revoke_object_url(&url).map_err(failed)
}

/// The address of the page without its fragment.
pub fn address() -> String {
    let href = window().ok().and_then(|(window, _)| window.location().href().ok()).unwrap_or_default();
    href.split('#').next().unwrap_or_default().to_owned()
}

/// The fragment of the address.
pub fn fragment() -> String {
    window().ok().and_then(|(window, _)| window.location().hash().ok()).unwrap_or_default()
}

fn storage() -> Option<Storage> {
    window().ok()?.0.local_storage().ok()?
}

/// The settings of the last session.
pub fn kept() -> Option<String> {
    storage()?.get_item(KEY).ok()?
}

/// Keeps the settings, if the browser has a storage.
pub fn keep(text: &str) {
    if let Some(storage) = storage() {
        let _ = storage.set_item(KEY, text);
    }
}

/// Keeps a draft of unsaved text. An error is one sentence.
pub fn keep_draft(key: &str, text: &str) -> Result<(), String> {
    let storage = storage().ok_or(tr!("window-this-browser-has-no-storage-for"))?;
    let full = |_| tr!("window-the-browser-s-storage-for-this").to_owned();
    storage.set_item(&format!("{DRAFT}{key}"), text).map_err(full)
}

/// Removes a draft.
pub fn remove_draft(key: &str) {
    if let Some(storage) = storage() {
        let _ = storage.remove_item(&format!("{DRAFT}{key}"));
    }
}

/// Takes over the draft that was left under this key.
pub fn take_draft(key: &str) -> Option<String> {
    let storage = storage()?;
    let numbered = |number: usize| if number == 1 { key.to_owned() } else { format!("{key}-{number}") };
    let read = |key: &String| storage.get_item(&format!("{DRAFT}{key}")).ok()?;
    let (found, text) = (1..=MOST_OF_ONE_FILE).map(numbered).find_map(|key| Some((key.clone(), read(&key)?)))?;
    if found != key {
        // Stored under its new name first, so that a draft exists at all times.
        keep_draft(key, &text).ok()?;
        remove_draft(&found);
    }
    Some(text)
}
