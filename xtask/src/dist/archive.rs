//! Reproducible archives: the same files give the same bytes. Names are sorted and relative, every file has the same time, and
//! nothing is known of the machine's users.

use flate2::{Compression, Crc, GzBuilder, write::DeflateEncoder};
use std::io::Write;

/// A file of an archive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ArchiveFile {
    /// The path in the archive, relative, with `/`.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
    /// Whether it is a program.
    pub executable: bool,
}

impl ArchiveFile {
    fn mode(&self) -> u32 {
        if self.executable { 0o755 } else { 0o644 }
    }
}

/// The files sorted by their names, all of which are relative, portable and different.
fn sorted(files: &[ArchiveFile]) -> Result<Vec<&ArchiveFile>, String> {
    let mut sorted: Vec<&ArchiveFile> = files.iter().collect();
    sorted.sort_by(|a, b| a.name.cmp(&b.name));
    for file in &sorted {
        let is_portable =
            |part: &str| !matches!(part, "" | "." | "..") && !part.contains(['\\', ':']) && part.is_ascii();
        if !file.name.split('/').all(is_portable) {
            return Err(format!("`{}` is not a relative, portable name for an archive", file.name));
        }
    }
    match sorted.windows(2).find(|pair| pair[0].name == pair[1].name) {
        Some(pair) => Err(format!("`{}` would be twice in the archive", pair[0].name)),
        None => Ok(sorted),
    }
}

const TAR_BLOCK: usize = 512;

/// A `.tar.gz` (POSIX ustar). `time` is in seconds since 1970.
pub fn tar_gz(files: &[ArchiveFile], time: u64) -> Result<Vec<u8>, String> {
    let mut tar = Vec::new();
    for file in sorted(files)? {
        tar.extend(tar_header(file, time)?);
        tar.extend(&file.bytes);
        tar.resize(tar.len().next_multiple_of(TAR_BLOCK), 0);
    }
    tar.resize(tar.len() + 2 * TAR_BLOCK, 0);
    // Neither a name nor a time in gzip's own header.
    let mut gzip = GzBuilder::new().mtime(0).write(Vec::new(), Compression::best());
    gzip.write_all(&tar).and_then(|()| gzip.finish()).map_err(|error| format!("gzip: {error}"))
}

fn tar_header(file: &ArchiveFile, time: u64) -> Result<[u8; TAR_BLOCK], String> {
    let mut header = [0; TAR_BLOCK];
    let mut put = |at: usize, text: &[u8]| header[at..at + text.len()].copy_from_slice(text);
    if file.name.len() > 100 {
        return Err(format!("`{}` is too long for a tar archive: at most 100 bytes", file.name));
    }
    put(0, file.name.as_bytes());
    put(100, format!("{:07o}", file.mode()).as_bytes());
    // Owner and group: 0, without names.
    put(108, b"0000000");
    put(116, b"0000000");
    put(124, format!("{:011o}", file.bytes.len()).as_bytes());
    put(136, format!("{time:011o}").as_bytes());
    put(148, b"        ");
    put(156, b"0");
    put(257, b"ustar\x0000");
    let sum: u32 = header.iter().map(|byte| u32::from(*byte)).sum();
    header[148..155].copy_from_slice(format!("{sum:06o}\0").as_bytes());
    Ok(header)
}

/// A `.zip`. `time` is in seconds since 1970; the archive has even seconds from 1980 on.
pub fn zip(files: &[ArchiveFile], time: u64) -> Result<Vec<u8>, String> {
    let (date, clock) = dos_time(time);
    let (mut zip, mut directory, mut count) = (Vec::new(), Vec::new(), 0u16);
    for file in sorted(files)? {
        let mut deflate = DeflateEncoder::new(Vec::new(), Compression::best());
        let packed = deflate.write_all(&file.bytes).and_then(|()| deflate.finish());
        let packed = packed.map_err(|error| format!("deflate: {error}"))?;
        let mut crc = Crc::new();
        crc.update(&file.bytes);
        let offset = length(zip.len())?;
        // Version 2.0, no flags, method 8 (deflate).
        let mut common = Vec::new();
        for number in [20, 0, 8, clock, date] {
            common.extend(u16::to_le_bytes(number));
        }
        for number in [crc.sum(), length(packed.len())?, length(file.bytes.len())?] {
            common.extend(number.to_le_bytes());
        }
        common.extend((file.name.len() as u16).to_le_bytes());
        common.extend([0; 2]);
        zip.extend(b"PK\x03\x04");
        zip.extend(&common);
        zip.extend(file.name.as_bytes());
        zip.extend(packed);
        // Made by Unix, so that the mode counts; no comment, disk 0.
        directory.extend(b"PK\x01\x02\x14\x03");
        directory.extend(&common);
        directory.extend([0; 6]);
        directory.extend(((0o100_000 | file.mode()) << 16).to_le_bytes());
        directory.extend(offset.to_le_bytes());
        directory.extend(file.name.as_bytes());
        count += 1;
    }
    let start = length(zip.len())?;
    zip.extend(&directory);
    zip.extend(b"PK\x05\x06\0\0\0\0");
    zip.extend(count.to_le_bytes());
    zip.extend(count.to_le_bytes());
    zip.extend(length(directory.len())?.to_le_bytes());
    zip.extend(start.to_le_bytes());
    zip.extend([0; 2]);
    Ok(zip)
}

fn length(bytes: usize) -> Result<u32, String> {
    u32::try_from(bytes).map_err(|_| "a zip archive holds at most 4 GiB".to_owned())
}

/// Date and time as zip archives have them, in UTC.
fn dos_time(time: u64) -> (u16, u16) {
    // Days since 0000-03-01, so that the day that a leap year adds comes last.
    let days = time / 86_400 + 719_468;
    let era = days / 146_097;
    let day_of_era = days % 146_097;
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = if month_from_march < 10 { month_from_march + 3 } else { month_from_march - 9 };
    let year = era * 400 + year_of_era + u64::from(month <= 2);
    if year < 1980 {
        return (1 << 5 | 1, 0);
    }
    let seconds = time % 86_400;
    let [hour, minute, second] = [seconds / 3600, seconds / 60 % 60, seconds % 60];
    let clock = hour << 11 | minute << 5 | (second / 2);
    (((year - 1980) << 9 | month << 5 | day) as u16, clock as u16)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::process;
    use std::process::Command;

    fn file(name: &str, bytes: &[u8], executable: bool) -> ArchiveFile {
        ArchiveFile { name: name.to_owned(), bytes: bytes.to_owned(), executable }
    }

    /// 2026-11-29 09:15:34 UTC.
    const TIME: u64 = 1_795_943_734;

    fn files() -> Vec<ArchiveFile> {
        vec![
            file("gonio-1/man/gonio.1", &b".TH\n".repeat(1000), false),
            file("gonio-1/gonio", b"\x7fELF", true),
            file("gonio-1/empty", b"", false),
            file("gonio-1/README.md", &[b'x'; 512], false),
        ]
    }

    #[test]
    fn the_order_of_the_files_does_not_matter() {
        for pack in [tar_gz, zip] {
            let archive = pack(&files(), TIME).unwrap();
            let mut turned = files();
            turned.reverse();
            assert!(archive == pack(&turned, TIME).unwrap());
            assert!(archive != pack(&files(), TIME + 2).unwrap());
        }
    }

    /// Python's own readers, which know nothing of this module.
    const READ: &str = "
import sys, tarfile, zipfile, hashlib, datetime
path = sys.argv[1]
if path.endswith('.zip'):
    z = zipfile.ZipFile(path)
    assert z.testzip() is None
    rows = [(i.filename, oct(i.external_attr >> 16), '%d-%02d-%02d %02d:%02d:%02d' % i.date_time, z.read(i)) for i in z.infolist()]
else:
    t = tarfile.open(path)
    time = lambda s: datetime.datetime.fromtimestamp(s, datetime.timezone.utc).strftime('%Y-%m-%d %H:%M:%S')
    rows = [(m.name, oct(m.mode | 0o100000), time(m.mtime), t.extractfile(m).read()) for m in t.getmembers()]
    assert all((m.uid, m.gid, m.uname, m.gname) == (0, 0, '', '') and m.isreg() for m in t.getmembers())
for name, mode, time, data in rows:
    print(name, mode, time, len(data), hashlib.sha256(data).hexdigest())
";

    #[test]
    fn other_programs_read_names_modes_times_and_bytes() {
        let mut expected = files();
        expected.sort_by(|a, b| a.name.cmp(&b.name));
        let lines: String = expected
            .iter()
            .map(|file| {
                let mode = if file.executable { "0o100755" } else { "0o100644" };
                let hash = crate::dist::sha256::hex(&file.bytes);
                format!("{} {mode} 2026-11-29 09:15:34 {} {hash}\n", file.name, file.bytes.len())
            })
            .collect();
        for extension in ["tar.gz", "zip"] {
            let pack = if extension == "zip" { zip } else { tar_gz };
            let path = std::env::temp_dir().join(format!("gonio-archive-{}.{extension}", std::process::id()));
            std::fs::write(&path, pack(&files(), TIME).unwrap()).unwrap();
            let read = process::stdout_of(Command::new("python3").args(["-c", READ]).arg(&path));
            std::fs::remove_file(&path).unwrap();
            assert_eq!(read.unwrap(), lines, "{extension}");
        }
    }

    #[test]
    fn names_that_would_lie_elsewhere_are_refused() {
        for name in ["/etc/passwd", "../a", "a/../b", "a//b", "a\\b", "C:a", "", "a/", "./a", "é"] {
            for pack in [tar_gz, zip] {
                assert!(pack(&[file(name, b"", false)], TIME).is_err(), "{name}");
            }
        }
        let twice = [file("a", b"1", false), file("a", b"2", false)];
        assert!(tar_gz(&twice, TIME).is_err() && zip(&twice, TIME).is_err());
        assert!(tar_gz(&[file(&"a".repeat(101), b"", false)], TIME).is_err());
    }

    #[test]
    fn times_are_those_of_the_calendar() {
        let date = |time| {
            let (date, clock) = dos_time(time);
            let hours = (clock >> 11, clock >> 5 & 63, (clock & 31) * 2);
            ((date >> 9) + 1980, date >> 5 & 15, date & 31, hours)
        };
        assert_eq!(date(951_782_400), (2000, 2, 29, (0, 0, 0)));
        assert_eq!(date(1_772_323_199), (2026, 2, 28, (23, 59, 58)));
        assert_eq!(date(1_772_323_200), (2026, 3, 1, (0, 0, 0)));
        assert_eq!(date(0), (1980, 1, 1, (0, 0, 0)));
    }
}
