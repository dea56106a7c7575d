//! Files that are no vertex buffers: an error that says where, never a panic.

#[allow(dead_code)]
mod support;

use gonio_exercises::buffers::{compare, read_buffer};
use support::{formats, models, random};

/// File name, bytes, line, column, and a part of the message.
type Bad = (&'static str, &'static [u8], Option<u64>, Option<u64>, &'static str);

const BAD: &[Bad] = &[
    ("a.csv", b"", None, None, "empty"),
    ("a.csv", b"\n# nothing\n\n", None, None, "no rows"),
    ("a.csv", b"x,y,z\n", None, None, "header and no rows"),
    ("a.csv", b"x,y,z\n1,2,3\n1,two,3\n", Some(3), Some(3), "`two` is not a number"),
    ("a.csv", b"1,2,3\n4,,6\n", Some(2), Some(3), "missing"),
    ("a.csv", b"1,2,3\n4,5\n", Some(2), None, "2 numbers, the first one 3"),
    ("a.csv", b"1,2,3,4\n", Some(1), None, "4 numbers"),
    ("a.csv", b"x,y,u,v\n1,2,3,4\n", Some(1), None, "no column z"),
    ("a.csv", b"x,y,z,u\n1,2,3,4\n", Some(1), None, "no column v"),
    ("a.csv", b"x,y,z,y\n1,2,3,4\n", Some(1), Some(7), "`y` is named twice"),
    ("a.csv", b"(1, 2, 3)\n", Some(1), Some(1), "`(1` is not a number"),
    ("a.csv", b"1,2,3\n\xFF,1,2\n", Some(2), Some(1), "UTF-8"),
    ("a.csv", b"1,2,3\n4,\0,6\n", Some(2), Some(3), "binary"),
    ("a.csv", b"\xFF\xFE1\0,\0", None, None, "UTF-16"),
    ("a.csv", b"1,0,0,5,0,0\n1,0,0,5,1\n", Some(2), None, "decimal comma"),
    ("a.raw", b"\0\0\0", None, None, "3 bytes"),
    ("a.raw", &[0; 16], None, None, "4 floats"),
    ("a.raw8", &[0; 36], None, None, "multiple of the 8"),
    ("a.json", b"[[1,2,3],\n[1,2,x]]", Some(2), Some(6), "invalid JSON"),
    ("a.json", b"[[1,2,NaN]]", Some(1), Some(7), "write null"),
    ("a.json", b"[]", None, None, "empty"),
    ("a.json", b"[[1,2,3],[4,5]]", None, None, "row 2 has 2 numbers"),
    ("a.json", b"[[1,2,3,4]]", None, None, "a row has 4 numbers"),
    ("a.json", b"[[1,2,3],\"x\"]", None, None, "row 2"),
    ("a.json", b"{\"colour\": 3}", None, None, "expected is"),
    ("a.json", b"7", None, None, "expected is"),
    ("a.json", b"[{\"x\":1,\"y\":2}]", None, None, "no number `z`"),
    ("a.json", b"[{\"position\":[1,2]}]", None, None, "2 numbers instead of 3"),
    ("a.json", b"{\"positions\":[[0,0,0]],\"normals\":[]}", None, None, "1 positions and 0 normals"),
    ("a.json", b"{\"vertices\":[[0,0,0]],\"indices\":[0,1,0]}", None, None, "count from 0"),
    ("a.json", b"{\"vertices\":[[0,0,0]],\"indices\":[0,-1,0]}", None, None, "index 2 is -1"),
    ("a.json", b"{\"vertices\":[0,0,0],\"indices\":[0,0,0]}", None, None, "list of rows"),
];

#[test]
fn errors_say_what_and_where() {
    for (name, bytes, line, column, part) in BAD {
        let text = String::from_utf8_lossy(bytes);
        let Err(error) = read_buffer(name, bytes) else { panic!("{name} {text:?} was read") };
        assert!(error.message.contains(part), "{name} {text:?}: {error}");
        assert_eq!((error.line, error.column), (*line, *column), "{name} {text:?}: {error}");
    }
}

#[test]
fn too_large_files_are_refused_before_they_are_read() {
    let large = vec![b'1'; gonio_exercises::buffers::MOST_BYTES + 1];
    assert!(read_buffer("a.csv", &large).expect_err("too large").message.contains("at most 100"));
    let error = read_buffer("a.json", &large[..40 << 20]).expect_err("too large");
    assert!(error.message.contains("at most 32"), "{error}");
    let deep = vec![b'['; 1 << 20];
    assert!(read_buffer("a.json", &deep).expect_err("too deep").message.contains("recursion"));
}

/// Every format cut off anywhere and with bytes changed: an error or a verdict.
#[test]
fn broken_files_never_panic() {
    let models = models();
    let (_, expected) = models.iter().find(|(name, _)| name == "tent.obj").expect("the tent");
    let vertices: Vec<_> = expected.vertices().take(12).collect();
    let (mut state, mut errors, mut verdicts) = (1, 0, 0);
    for format in formats(&vertices, expected.attributes()) {
        for at in 0..format.bytes.len().min(400) {
            let mut changed = format.bytes.clone();
            changed[at] = random(&mut state, 256) as u8;
            for bytes in [&format.bytes[..at], &format.bytes[at..], &changed] {
                match read_buffer(&format.file, bytes) {
                    Ok(buffer) => {
                        verdicts += 1;
                        if at % 16 == 0 {
                            compare(expected, &buffer);
                        }
                    }
                    Err(error) => {
                        errors += 1;
                        assert!(!error.message.is_empty());
                    }
                }
            }
        }
    }
    assert!(errors > 5000 && verdicts > 3000, "{errors} errors, {verdicts} verdicts");
}

/// Numbers at the ends of what floats hold, in a buffer and in a model.
#[test]
fn extreme_numbers_are_compared() {
    let models = models();
    let rows = ["nan,nan,nan", "inf,-inf,1e38", "-1e38,1e-45,0", "1e400,0,-0"];
    let buffer = read_buffer("a.csv", rows.join("\n").as_bytes()).expect("a buffer");
    for (_, expected) in &models {
        assert_ne!(compare(expected, &buffer).verdict, gonio_check::verdict::Outcome::Correct);
    }
    let extreme = b"v 1e38 -1e38 0\nv 3e38 0 1e-45\nv 0 1 -3e38\nvn 0 0 0\nf 1//1 2//1 3//1\nf -9223372036854775808 \
                    1 2\nf 9223372036854775807 1 2\n";
    let expected = gonio_exercises::buffers::Expected::from_obj(extreme).expect("a model");
    compare(&expected, &buffer);
    assert_eq!(expected.triangle_count(), 1);
}
