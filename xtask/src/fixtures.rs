//! Tables of test cases, unpacked for programs that read files.

use gonio_fixtures::{FixtureTable, tables_below};
use std::path::{Path, PathBuf};

/// Writes the files of the table `from`, or of all tables below the folder `from`, into a folder below the target folder that
/// contains nothing else, and returns that folder. `purpose` names it.
pub fn unpack(root: &Path, from: &str, purpose: &str) -> Result<PathBuf, String> {
    let source = root.join(from);
    let tables = match source.is_dir() {
        true => tables_below(&source),
        false => FixtureTable::read(&source).map(|table| vec![(PathBuf::new(), table)]),
    };
    let tables = tables.map_err(|error| error.to_string())?;
    if tables.is_empty() {
        return Err(format!("{from} contains no tables of test cases"));
    }
    let name = from.trim_end_matches(".txt").replace('/', "-");
    let folder = crate::target::target_folder(root).join("fixtures").join(purpose).join(name);
    let not_written = |error| format!("cannot unpack {from} into {}: {error}", folder.display());
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(not_written)?;
    }
    for (below, table) in tables {
        table.unpack(&folder.join(below)).map_err(not_written)?;
    }
    Ok(folder)
}
