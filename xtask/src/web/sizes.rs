//! The sizes of the page's files.

use serde_json::Value;

/// The most bytes that a first visit may load before its first picture, all files together, compressed by brotli: over a slow
/// mobile connection (4 Mbit/s) they take 0.6 s.
pub const MOST_BYTES: u64 = 310_000;
/// The most of them for the module that draws it, with its bindings.
pub const MOST_MODULE_BYTES: u64 = 250_000;
/// The most bytes until the application runs, those of the first picture included, compressed by brotli. Workers load more when a
/// feature needs them.
pub const MOST_START_BYTES: u64 = 3_200_000;

/// What waits for a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum When {
    /// The first picture.
    First,
    /// The start of the application.
    Start,
    /// A feature, or nothing.
    Later,
}

/// One file of the page.
pub struct Size {
    /// The path below `dist`, with `/`.
    pub name: String,
    /// Uncompressed bytes.
    pub bytes: u64,
    /// Bytes after gzip.
    pub gzip: u64,
    /// Bytes after brotli.
    pub brotli: u64,
    /// What waits for it.
    pub when: When,
}

/// All files of the page.
pub struct Sizes {
    /// A hash of all files.
    pub version: String,
    /// The files, unordered.
    pub files: Vec<Size>,
}

impl Sizes {
    /// Reads the output of `pack.mjs`.
    pub fn read(json: &str) -> Result<Sizes, String> {
        let value: Value = serde_json::from_str(json).map_err(|e| format!("pack.mjs printed invalid JSON: {e}"))?;
        let file = |value: &Value| {
            Some(Size {
                name: value["name"].as_str()?.to_owned(),
                bytes: value["bytes"].as_u64()?,
                gzip: value["gzip"].as_u64()?,
                brotli: value["brotli"].as_u64()?,
                when: match value["when"].as_str()? {
                    "first" => When::First,
                    "start" => When::Start,
                    "later" => When::Later,
                    _ => return None,
                },
            })
        };
        let files = value["files"].as_array().and_then(|files| files.iter().map(file).collect::<Option<Vec<_>>>());
        match (value["version"].as_str(), files) {
            (Some(version), Some(files)) if !files.is_empty() => Ok(Sizes { version: version.to_owned(), files }),
            _ => Err(format!("unexpected output of pack.mjs: {json}")),
        }
    }

    /// Bytes that a first visit loads before its first picture, after brotli.
    pub fn first_visit(&self) -> u64 {
        self.files.iter().filter(|file| file.when == When::First).map(|file| file.brotli).sum()
    }

    /// Bytes of the module that draws the first picture, with its bindings, after brotli.
    pub fn first_module(&self) -> u64 {
        let is_its =
            |file: &&Size| file.when == When::First && (file.name.ends_with(".wasm") || file.name.ends_with(".js"));
        self.files.iter().filter(is_its).map(|file| file.brotli).sum()
    }

    /// Bytes until the application runs, after brotli.
    pub fn start(&self) -> u64 {
        self.files.iter().filter(|file| file.when <= When::Start).map(|file| file.brotli).sum()
    }

    /// One line per file, the largest first, and the totals.
    pub fn table(&self) -> String {
        let mut files: Vec<&Size> = self.files.iter().collect();
        files.sort_by_key(|file| (file.when, std::cmp::Reverse(file.brotli)));
        let row = |name: &str, [bytes, gzip, brotli]: [u64; 3]| {
            format!("{name:<40} {:>12} {:>12} {:>12}\n", grouped(bytes), grouped(gzip), grouped(brotli))
        };
        let sum = |until: When| {
            let of = |pick: fn(&Size) -> u64| files.iter().filter(|f| f.when <= until).map(|f| pick(f)).sum();
            [of(|f| f.bytes), of(|f| f.gzip), of(|f| f.brotli)]
        };
        let mut table = format!("{:<40} {:>12} {:>12} {:>12}\n", "", "bytes", "gzip", "brotli");
        for file in &files {
            table += &row(&file.name, [file.bytes, file.gzip, file.brotli]);
        }
        table += &row("before the first picture", sum(When::First));
        table += &row("until the application runs", sum(When::Start));
        table += &row("total", sum(When::Later));
        table
    }
}

/// `1234567` as `1 234 567`.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const PRINTED: &str = r#"{"version": "ab", "files": [
        {"name": "icon.svg", "bytes": 900, "gzip": 400, "brotli": 300, "when": "later"},
        {"name": "gonio-first.wasm", "bytes": 3000000, "gzip": 1200000, "brotli": 900000, "when": "first"},
        {"name": "gonio.wasm", "bytes": 9000000, "gzip": 3000000, "brotli": 2000000, "when": "start"},
        {"name": "page.css", "bytes": 900, "gzip": 600, "brotli": 500, "when": "first"},
        {"name": "main.js", "bytes": 60000, "gzip": 12000, "brotli": 10000, "when": "first"}]}"#;

    #[test]
    fn bytes_are_summed_by_what_waits_for_them() {
        let sizes = Sizes::read(PRINTED).unwrap();
        assert_eq!((sizes.version.as_str(), sizes.first_visit(), sizes.first_module()), ("ab", 910_500, 910_000));
        let table = sizes.table();
        let line = |start: &str| table.lines().find(|line| line.starts_with(start)).unwrap().to_owned();
        assert!(line("before the first picture").ends_with("910 500"), "{table}");
        assert_eq!(sizes.start(), 2_910_500);
        assert!(line("until the application runs").ends_with("2 910 500"), "{table}");
        assert!(line("total").ends_with("2 910 800"), "{table}");
    }

    #[test]
    fn malformed_lists_of_sizes_are_refused() {
        for bad in ["", "{}", r#"{"version": "ab", "files": []}"#, r#"{"version": "ab", "files": [{"name": "a"}]}"#] {
            assert!(Sizes::read(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn digits_are_grouped_by_three() {
        assert_eq!([0, 999, 1000, 1234567].map(grouped), ["0", "999", "1 000", "1 234 567"]);
    }
}
