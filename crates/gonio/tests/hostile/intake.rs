//! Entries that are not text, not files, or too large, in folders and zip archives.

use crate::case::{Answer, Case, Fill};
use flate2::write::DeflateEncoder;
use flate2::{Compression, Crc};
use std::ffi::OsString;
use std::io::Write;
use std::os::unix::ffi::OsStringExt;

pub fn cases() -> Vec<Case> {
    let answer = Answer::wrong("ex04");
    let (vertex, fragment) = (answer.vertex.clone().into_bytes(), answer.fragment.clone().into_bytes());
    let mut cases = Vec::new();
    let case = |name: &str| Case::new("intake", name, "ex04");
    let utf16 = |text: &str, big: bool| -> Vec<u8> {
        let units = std::iter::once(0xfeff).chain(text.encode_utf16());
        units.flat_map(|unit: u16| if big { unit.to_be_bytes() } else { unit.to_le_bytes() }).collect()
    };
    for big in [false, true] {
        let name = if big { "UTF-16, the high byte first" } else { "UTF-16" };
        cases.push(case(name).pair(utf16(&answer.vertex, big), utf16(&answer.fragment, big)));
    }
    let around = |before: &[u8], middle: &[u8], after: &[u8]| [before, middle, after].concat();
    let halves = |bytes: &[u8], middle: &[u8]| around(&bytes[..bytes.len() / 2], middle, &bytes[bytes.len() / 2..]);
    cases.push(case("NULs in the middle").pair(vertex.clone(), halves(&fragment, &[0; 100])));
    cases.push(case("only NULs").pair(vec![0; 4096], vec![0; 4096]));
    cases.push(case("invalid UTF-8").pair(vertex.clone(), halves(&fragment, b"\xff\xfe\xc0\x80\xed\xa0\x80\xf5")));
    cases.push(case("Latin-1 in a comment").pair(vertex.clone(), around(b"", &fragment, b"// f\xfcr dich\n")));
    cases.push(case("a mark of order in the middle").pair(vertex.clone(), halves(&fragment, "\u{feff}".as_bytes())));
    cases.push(
        case("marks of order in the beginning")
            .pair(vertex.clone(), around("\u{feff}\u{feff}".as_bytes(), &fragment, b"")),
    );
    cases.push(case("CR alone").pair(vertex.clone(), answer.fragment.replace('\n', "\r")));
    cases.push(case("LF CR").pair(vertex.clone(), answer.fragment.replace('\n', "\n\r")));
    cases.push(case("an end of file of DOS").pair(vertex.clone(), around(b"", &fragment, b"\x1a")));
    cases.push(case("empty files").pair("", ""));
    cases.push(case("no files"));
    cases.push(case("one file alone").file("a.frag", Fill::Bytes(fragment.clone())));
    cases.push(
        case("folders of the right names")
            .file("readme.txt", Fill::Bytes(b"x".to_vec()))
            .file("a.vert/x", Fill::Bytes(vertex.clone()))
            .file("a.frag/x", Fill::Bytes(fragment.clone())),
    );
    let grown = |name: &str, piece: &str, count: usize| {
        let fill = Fill::Repeat(fragment.clone(), piece.as_bytes().to_vec(), count, Vec::new());
        case(name).file("a.vert", Fill::Bytes(vertex.clone())).file("a.frag", fill)
    };
    cases.push(grown("10 MB of blanks", " ", 10_000_000));
    cases.push(grown("a line of 5 MB", "+ 1.0 ", 800_000));
    cases.push(grown("a comment of 5 MB", "// abcdefgh", 450_000));
    cases.push(grown("100,000 lines", "// a line\n", 100_000));
    cases.push(grown("100,000 errors", "x y z;\n", 100_000));
    cases.push(grown("100,000 empty comments", "/**/", 100_000));
    cases.push(grown("100,000 backslashes", "\\\n", 100_000));
    cases.push(grown("100,000 quotes", "\"", 100_001));
    cases.push(grown("100,000 directives", "#define A A\n", 100_000));
    let pair =
        |case: Case| case.file("a.vert", Fill::Bytes(vertex.clone())).file("a.frag", Fill::Bytes(fragment.clone()));
    cases.push(pair(case("a file of 8 TB")).file("b.frag", Fill::Sparse(8 << 40)));
    cases.push(
        case("shaders of 31 MB of nothing")
            .file("a.vert", Fill::Sparse(31 << 20))
            .file("a.frag", Fill::Sparse(31 << 20)),
    );
    cases.push(pair(case("a pipe")).file("b.frag", Fill::Pipe));
    cases.push(
        case("a pipe by its name")
            .file("a.frag", Fill::Pipe)
            .file("a.vert", Fill::Bytes(vertex.clone()))
            .named(&["a.vert", "a.frag"]),
    );
    cases.push(pair(case("a link to its own folder")).file("loop", Fill::Link(".".into())));
    cases.push(case("a link to itself").file("a.vert", Fill::Link("a.vert".into())).named(&["a.vert"]));
    cases.push(pair(case("a link to nothing")).file("b.frag", Fill::Link("/nowhere/at/all".into())));
    for device in ["/dev/zero", "/dev/urandom", "/dev/full", "/dev/null", "/dev/stdin", "/proc/self/mem"] {
        cases.push(pair(case(&format!("{device} by its name"))).named(&["a.vert", device]));
    }
    cases.push(pair(case("a link to a device")).file("b.frag", Fill::Link("/dev/zero".into())));
    let long = "n".repeat(250);
    cases.push(
        case("names of 255 bytes")
            .file(format!("{long}.vert"), Fill::Bytes(vertex.clone()))
            .file(format!("{long}.frag"), Fill::Bytes(fragment.clone())),
    );
    cases.push(
        case("names that begin with -")
            .file("-a.vert", Fill::Bytes(vertex.clone()))
            .file("--json.frag", Fill::Bytes(fragment.clone()))
            .named(&["-a.vert", "--json.frag"]),
    );
    let latin = |end: &[u8]| OsString::from_vec([b"sch\xf6n\xff", end].concat());
    cases.push(
        case("names that are no UTF-8")
            .file(latin(b".vert"), Fill::Bytes(vertex.clone()))
            .file(latin(b".frag"), Fill::Bytes(fragment.clone())),
    );
    let deep = "d/".repeat(200);
    cases.push(
        case("200 folders deep")
            .of_many()
            .file(format!("{deep}a.vert"), Fill::Bytes(vertex.clone()))
            .file(format!("{deep}a.frag"), Fill::Bytes(fragment.clone())),
    );
    let many =
        (0..3000).fold(pair(case("3000 files")), |case, i| case.file(format!("x{i}.txt"), Fill::Bytes(b"x".to_vec())));
    cases.push(many);
    let pairs = (0..60).fold(case("60 pairs"), |case, i| {
        case.file(format!("p{i}.vert"), Fill::Bytes(vertex.clone()))
            .file(format!("p{i}.frag"), Fill::Bytes(fragment.clone()))
    });
    cases.push(pairs);
    cases.extend(zips(&vertex, &fragment));
    cases
}

/// Zips by their names: within a folder they would be submissions of their own.
fn zips(vertex: &[u8], fragment: &[u8]) -> Vec<Case> {
    let case =
        |name: &str, zip: Vec<u8>| Case::new("intake", name, "ex04").file("a.zip", Fill::Bytes(zip)).named(&["a.zip"]);
    let pair = [("a.vert".to_owned(), vertex.to_vec()), ("a.frag".to_owned(), fragment.to_vec())];
    let zeros = vec![0; 30 << 20];
    let bomb: Vec<(String, Vec<u8>)> = (0..40).map(|i| (format!("b{i}.frag"), zeros.clone())).collect();
    let nested = (0..6).fold(pack(&pair), |inner, i| pack(&[(format!("z{i}.zip"), inner)]));
    let named = |name: &str| pack(&[(name.to_owned(), fragment.to_vec()), ("a.vert".to_owned(), vertex.to_vec())]);
    let whole = pack(&pair);
    vec![
        case("a zip", whole.clone()),
        case("a zip bomb", pack(&bomb)),
        case("a zip within zips", nested),
        case("a zip with a way out", named("../../../../tmp/gonio-hostile.frag")),
        case("a zip with a path from the root", named("/tmp/gonio-hostile.frag")),
        case("a zip with a hostile name", named(&format!("a{}.frag", crate::common::EVIL))),
        case("a zip with the same name twice", pack(&[pair[0].clone(), pair[0].clone(), pair[1].clone()])),
        case(
            "a zip of 3000 files",
            pack(&(0..3000).map(|i| (format!("x{i}.frag"), b"x".to_vec())).collect::<Vec<_>>()),
        ),
        case("half a zip", whole[..whole.len() / 2].to_vec()),
        case("a zip that lies about its sizes", with_sizes(&whole, u32::MAX - 1)),
        case("an empty zip", pack(&[])),
    ]
}

/// A zip of these files, deflated.
fn pack(files: &[(String, Vec<u8>)]) -> Vec<u8> {
    let (mut zip, mut directory) = (Vec::new(), Vec::new());
    for (name, content) in files {
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(content).unwrap();
        let packed = encoder.finish().unwrap();
        let mut sum = Crc::new();
        sum.update(content);
        let offset = zip.len() as u32;
        // Version, flags (names are UTF-8), method, time, date; then sums and sizes, and the lengths of name and extra.
        let mut fields: Vec<u8> = [20_u16, 0x800, 8, 0, 0x21].into_iter().flat_map(u16::to_le_bytes).collect();
        for number in [sum.sum(), packed.len() as u32, content.len() as u32] {
            fields.extend(number.to_le_bytes());
        }
        fields.extend([name.len() as u16, 0].into_iter().flat_map(u16::to_le_bytes));
        zip.extend([b"PK\x03\x04", fields.as_slice(), name.as_bytes(), &packed].concat());
        directory.extend(
            [b"PK\x01\x02\x14\x00", fields.as_slice(), &[0; 10], &offset.to_le_bytes(), name.as_bytes()].concat(),
        );
    }
    let (count, start) = (files.len() as u16, zip.len() as u32);
    zip.extend_from_slice(&directory);
    zip.extend(b"PK\x05\x06\0\0\0\0");
    zip.extend([count, count].into_iter().flat_map(u16::to_le_bytes));
    zip.extend([directory.len() as u32, start].into_iter().flat_map(u32::to_le_bytes));
    zip.extend([0, 0]);
    zip
}

/// The same archive with other sizes of the files in its directory.
fn with_sizes(zip: &[u8], size: u32) -> Vec<u8> {
    let mut zip = zip.to_vec();
    let starts: Vec<usize> = (0..zip.len()).filter(|&at| zip[at..].starts_with(b"PK\x01\x02")).collect();
    for start in starts {
        zip[start + 24..start + 28].copy_from_slice(&size.to_le_bytes());
    }
    zip
}
