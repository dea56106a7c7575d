//! The files of the page: built into the program, or in a folder.

use crate::report::CliError;
use std::collections::BTreeMap;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// `(name, bytes)` of the page that was there when this was compiled; see `build.rs`.
const EMBEDDED: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/embedded_page.rs"));

/// The page's files by their names: from the page's top, with `/`.
pub struct Page {
    files: BTreeMap<String, Forms>,
}

/// One file, in the forms in which it is there.
#[derive(Default)]
pub struct Forms {
    /// As it is.
    plain: Option<Stored>,
    /// Compressed by brotli (RFC 7932).
    brotli: Option<Stored>,
    /// Compressed by gzip (RFC 1952).
    gzip: Option<Stored>,
}

/// Where bytes are.
enum Stored {
    Embedded(&'static [u8]),
    OnDisk(PathBuf),
}

/// How a file is sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// As it is.
    Identity,
    /// `br`
    Brotli,
    /// `gzip`
    Gzip,
}

impl Encoding {
    /// As a header names it.
    pub fn name(self) -> &'static str {
        match self {
            Encoding::Identity => "identity",
            Encoding::Brotli => "br",
            Encoding::Gzip => "gzip",
        }
    }
}

impl Page {
    /// The page built into this program, if there is one.
    pub fn embedded() -> Option<Page> {
        if EMBEDDED.is_empty() {
            return None;
        }
        Some(Page::of(EMBEDDED.iter().map(|(name, bytes)| ((*name).to_owned(), Stored::Embedded(bytes)))))
    }

    /// The page in a folder. Only files that are there now will be served.
    pub fn in_folder(folder: &Path) -> Result<Page, CliError> {
        let mut files = Vec::new();
        list(folder, "", &mut files).map_err(|error| CliError::io(folder.display(), &error))?;
        let page = Page::of(files.into_iter().map(|(name, path)| (name, Stored::OnDisk(path))));
        if page.file("index.html").is_none() {
            return Err(CliError::new(format!(
                "{}: there is no index.html; `cargo xtask web` builds the page into dist",
                folder.display()
            )));
        }
        Ok(page)
    }

    fn of(stored: impl Iterator<Item = (String, Stored)>) -> Page {
        let mut files: BTreeMap<String, Forms> = BTreeMap::new();
        for (name, bytes) in stored {
            if let Some(plain) = name.strip_suffix(".br") {
                files.entry(plain.to_owned()).or_default().brotli = Some(bytes);
            } else if let Some(plain) = name.strip_suffix(".gz") {
                files.entry(plain.to_owned()).or_default().gzip = Some(bytes);
            } else {
                files.entry(name).or_default().plain = Some(bytes);
            }
        }
        Page { files }
    }

    /// A file by its name.
    pub fn file(&self, name: &str) -> Option<&Forms> {
        self.files.get(name)
    }
}

impl Forms {
    /// The smallest form that the client takes, and its bytes. Errors are of the disk.
    pub fn read(&self, takes: impl Fn(&str) -> bool) -> io::Result<(Encoding, Vec<u8>)> {
        for (form, encoding) in [(&self.brotli, Encoding::Brotli), (&self.gzip, Encoding::Gzip)] {
            if let Some(stored) = form
                && takes(encoding.name())
            {
                return Ok((encoding, stored.read()?));
            }
        }
        let bytes = match (&self.plain, &self.gzip) {
            (Some(plain), _) => plain.read()?,
            (None, Some(gzip)) => unpack(&gzip.read()?)?,
            (None, None) => return Err(io::Error::other("it is there in brotli alone")),
        };
        Ok((Encoding::Identity, bytes))
    }

    /// Whether it depends on what the client takes.
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

/// Our own files, so there is no limit on what comes of them.
fn unpack(gzip: &[u8]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    flate2::read::GzDecoder::new(gzip).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Every file below the folder. Names that begin with a dot are nobody's page; links are not followed.
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
