//! How many bytes the page is.

use serde_json::Value;

/// The most that a first visit may load until its first picture, all files together, compressed by brotli: so that the
/// page does not grow unnoticed. The project's fifth issue asks for 1.0 MB. The laboratory's exercises and its bank of
/// mistakes are 45 kB of it: data stays in the module's first half.
pub const MOST_BYTES: u64 = 950_000;

/// One file of the page.
pub struct Size {
    /// Below `dist`, with `/`.
    pub name: String,
    /// As it is.
    pub bytes: u64,
    /// Compressed by gzip.
    pub gzip: u64,
    /// Compressed by brotli.
    pub brotli: u64,
    /// Whether the first picture waits for it.
    pub first: bool,
}

/// All files of the page.
pub struct Sizes {
    /// A hash over everything.
    pub version: String,
    /// In no order.
    pub files: Vec<Size>,
}

impl Sizes {
    /// From what `pack.mjs` prints.
    pub fn read(json: &str) -> Result<Sizes, String> {
        let value: Value = serde_json::from_str(json).map_err(|e| format!("pack.mjs printed no JSON: {e}"))?;
        let file = |value: &Value| {
            Some(Size {
                name: value["name"].as_str()?.to_owned(),
                bytes: value["bytes"].as_u64()?,
                gzip: value["gzip"].as_u64()?,
                brotli: value["brotli"].as_u64()?,
                first: value["first"].as_bool()?,
            })
        };
        let files = value["files"].as_array().and_then(|files| files.iter().map(file).collect::<Option<Vec<_>>>());
        match (value["version"].as_str(), files) {
            (Some(version), Some(files)) if !files.is_empty() => Ok(Sizes { version: version.to_owned(), files }),
            _ => Err(format!("pack.mjs printed something else than sizes: {json}")),
        }
    }

    /// What a first visit loads until its first picture, by brotli.
    pub fn first_visit(&self) -> u64 {
        self.files.iter().filter(|file| file.first).map(|file| file.brotli).sum()
    }

    /// A line for each file, the largest first, and the sums.
    pub fn table(&self) -> String {
        let mut files: Vec<&Size> = self.files.iter().collect();
        files.sort_by_key(|file| (!file.first, std::cmp::Reverse(file.brotli)));
        let row = |name: &str, [bytes, gzip, brotli]: [u64; 3]| {
            format!("{name:<40} {:>12} {:>12} {:>12}\n", grouped(bytes), grouped(gzip), grouped(brotli))
        };
        let sum = |first: bool| {
            let of = |pick: fn(&Size) -> u64| files.iter().filter(|f| f.first || !first).map(|f| pick(f)).sum();
            [of(|f| f.bytes), of(|f| f.gzip), of(|f| f.brotli)]
        };
        let mut table = format!("{:<40} {:>12} {:>12} {:>12}\n", "", "bytes", "gzip", "brotli");
        for file in &files {
            table += &row(&file.name, [file.bytes, file.gzip, file.brotli]);
        }
        table += &row("until the first picture", sum(true));
        table += &row("everything", sum(false));
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
        {"name": "icon.svg", "bytes": 900, "gzip": 400, "brotli": 300, "first": false},
        {"name": "gonio.wasm", "bytes": 3000000, "gzip": 1200000, "brotli": 900000, "first": true},
        {"name": "main.js", "bytes": 60000, "gzip": 12000, "brotli": 10000, "first": true}]}"#;

    #[test]
    fn sums_are_of_what_the_first_picture_waits_for() {
        let sizes = Sizes::read(PRINTED).unwrap();
        assert_eq!((sizes.version.as_str(), sizes.first_visit()), ("ab", 910_000));
        let table = sizes.table();
        let line = |start: &str| table.lines().find(|line| line.starts_with(start)).unwrap().to_owned();
        assert!(line("until the first picture").ends_with("910 000"), "{table}");
        assert!(line("everything").ends_with("910 300"), "{table}");
    }

    #[test]
    fn what_is_no_list_of_sizes_is_refused() {
        for bad in ["", "{}", r#"{"version": "ab", "files": []}"#, r#"{"version": "ab", "files": [{"name": "a"}]}"#] {
            assert!(Sizes::read(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn digits_stand_in_threes() {
        assert_eq!([0, 999, 1000, 1234567].map(grouped), ["0", "999", "1 000", "1 234 567"]);
    }
}
