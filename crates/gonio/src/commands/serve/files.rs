//! The files of the page, embedded in the program or in a folder.

use crate::error::CliError;
use std::collections::BTreeMap;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// `(name, bytes)` of the page that existed when this was compiled; see `build.rs`.
const EMBEDDED: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/embedded_page.rs"));

/// The page's files by their names, relative to its top folder, with `/`.
pub struct WebPage {
    files: BTreeMap<String, ServedFile>,
}

/// One file in the encodings that exist.
#[derive(Default)]
pub struct ServedFile {
    /// Not compressed.
    plain: Option<Stored>,
    /// Compressed by brotli (RFC 7932).
    brotli: Option<Stored>,
    /// Compressed by gzip (RFC 1952).
    gzip: Option<Stored>,
}

/// The bytes of a file.
enum Stored {
    Embedded(&'static [u8]),
    OnDisk(PathBuf),
}

/// The content encoding of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContentEncoding {
    Identity,
    Brotli,
    Gzip,
}

impl ContentEncoding {
    /// The name in headers.
    pub fn name(self) -> &'static str {
        match self {
            ContentEncoding::Identity => "identity",
            ContentEncoding::Brotli => "br",
            ContentEncoding::Gzip => "gzip",
        }
    }
}

impl WebPage {
    /// The page embedded in this program, if it has one.
    pub fn embedded() -> Option<WebPage> {
        if EMBEDDED.is_empty() {
            return None;
        }
        Some(WebPage::from_files(EMBEDDED.iter().map(|(name, bytes)| ((*name).to_owned(), Stored::Embedded(bytes)))))
    }

    /// The page in a folder. Only files that exist now will be served.
    pub fn in_folder(folder: &Path) -> Result<WebPage, CliError> {
        let mut files = Vec::new();
        list(folder, "", &mut files).map_err(|error| CliError::io(folder.display(), &error))?;
        let page = WebPage::from_files(files.into_iter().map(|(name, path)| (name, Stored::OnDisk(path))));
        if page.file("index.html").is_none() {
            return Err(CliError::new(format!(
                "{}: there is no index.html; `cargo xtask web` builds the page into the folder dist",
                folder.display()
            )));
        }
        Ok(page)
    }

    fn from_files(stored: impl Iterator<Item = (String, Stored)>) -> WebPage {
        let mut files: BTreeMap<String, ServedFile> = BTreeMap::new();
        for (name, bytes) in stored {
            if let Some(plain) = name.strip_suffix(".br") {
                files.entry(plain.to_owned()).or_default().brotli = Some(bytes);
            } else if let Some(plain) = name.strip_suffix(".gz") {
                files.entry(plain.to_owned()).or_default().gzip = Some(bytes);
            } else {
                files.entry(name).or_default().plain = Some(bytes);
            }
        }
        WebPage { files }
    }

    pub fn file(&self, name: &str) -> Option<&ServedFile> {
        self.files.get(name)
    }
}

impl ServedFile {
    /// The smallest encoding that the client accepts, and its bytes.
    pub fn read(&self, accepts: impl Fn(&str) -> bool) -> io::Result<(ContentEncoding, Vec<u8>)> {
        for (stored, encoding) in [(&self.brotli, ContentEncoding::Brotli), (&self.gzip, ContentEncoding::Gzip)] {
            if let Some(stored) = stored
                && accepts(encoding.name())
            {
                return Ok((encoding, stored.read()?));
            }
        }
        let bytes = match (&self.plain, &self.gzip) {
            (Some(plain), _) => plain.read()?,
            (None, Some(gzip)) => unpack(&gzip.read()?)?,
            (None, None) => return Err(io::Error::other("the file exists in brotli only")),
        };
        Ok((ContentEncoding::Identity, bytes))
    }

    /// Whether the answer depends on what the client accepts.
    pub fn varies(&self) -> bool {
        self.brotli.is_some() || self.gzip.is_some()
    }
}

impl Stored {
    fn read(&self) -> io::Result<Vec<u8>> {
        match self {
            Stored::Embedded(bytes) => Ok(bytes.to_vec()),
            Stored::OnDisk(path) => std::fs::read(path),
        }
    }
}

/// Unpacks a file of our own, without a limit on its size.
fn unpack(gzip: &[u8]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    flate2::read::GzDecoder::new(gzip).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Adds every file below the folder, except those whose names begin with a dot. Links are not followed.
fn list(folder: &Path, above: &str, files: &mut Vec<(String, PathBuf)>) -> io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let Ok(name) = entry.file_name().into_string() else { continue };
        if name.starts_with('.') {
            continue;
        }
        let kind = entry.file_type()?;
        let name = format!("{above}{name}");
        if kind.is_dir() {
            list(&entry.path(), &format!("{name}/"), files)?;
        } else if kind.is_file() {
            files.push((name, entry.path()));
        }
    }
    Ok(())
}
