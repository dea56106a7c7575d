//! No source makes the front end panic or hang, however malformed it is.

use gonio_fixtures::FixtureTable;
use gonio_glsl::{OutputVersion, Stage, check, check_pair, leaves, parse, translate};

/// Returns the shaders of the table `pairs.txt`.
fn sources() -> Vec<String> {
    let table = FixtureTable::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/pairs.txt"));
    let table = table.unwrap_or_else(|error| panic!("{error}"));
    assert!(table.files().len() >= 50, "only {} shaders", table.files().len());
    table.files().iter().map(|file| String::from_utf8(file.bytes.clone()).expect("the file is UTF-8")).collect()
}

/// Parses, checks and translates a source as both stages.
fn process(source: &str) {
    let mut both = Vec::new();
    for stage in [Stage::Vertex, Stage::Fragment] {
        let mut parsed = parse(source);
        let checked = check(&mut parsed, stage);
        for target in [OutputVersion::Core330, OutputVersion::Es300] {
            assert!(!translate(&parsed, &checked, target).text.is_empty());
        }
        for problem in parsed.problems.iter().chain(&checked.problems) {
            let (start, end) = (problem.span.start as usize, problem.span.end as usize);
            assert!(source.is_char_boundary(start) && source.is_char_boundary(end) && start <= end, "{problem}");
        }
        both.push(checked);
    }
    let _ = check_pair(&both[0], &both[1]);
}

#[test]
fn truncated_sources() {
    for source in sources() {
        for end in (0..=source.len()).filter(|end| source.is_char_boundary(*end)) {
            process(&source[..end]);
        }
    }
}

#[test]
fn words_removed_duplicated_and_swapped() {
    let mut random = 12345_u64;
    let mut next = |below: usize| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) as usize % below.max(1)
    };
    for source in sources() {
        let words: Vec<&str> = source.split_inclusive([' ', '\n', '(', ')', ';', '{', '}', ',']).collect();
        for _ in 0..60 {
            let mut words = words.clone();
            for _ in 0..=next(4) {
                let (a, b) = (next(words.len()), next(words.len()));
                match next(3) {
                    0 => drop(words.remove(a)),
                    1 => words.insert(a, words[b]),
                    _ => words.swap(a, b),
                }
            }
            process(&words.concat());
        }
    }
}

#[test]
fn random_bytes() {
    let mut random = 99_u64;
    for length in 0..400 {
        let mut bytes = Vec::new();
        for _ in 0..length {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            bytes.push((random >> 40) as u8);
        }
        process(&String::from_utf8_lossy(&bytes));
        let marks = b"(){}[];,.#\\\n\"'+-*/<>=!~&|^?: aA0_x\r\t";
        let text: Vec<u8> = bytes.iter().map(|b| marks[*b as usize % marks.len()]).collect();
        process(&String::from_utf8_lossy(&text));
    }
}

#[test]
fn deep_nesting_on_a_small_stack() {
    let deep = |open: &str, close: &str, count| {
        format!("void main() {{ float x = {}1.0{}; }}", open.repeat(count), close.repeat(count))
    };
    let mut sources = Vec::new();
    for count in [150, 100_000] {
        sources.push(deep("(", ")", count));
        sources.push(deep("-", "", count));
        sources.push(deep("sin(", ")", count));
        sources.push(deep("a[", "]", count));
        sources.push(deep("true ? 1.0 : ", "", count));
        sources.push(deep("x = ", "", count));
        sources.push(deep("", " + 1.0", count));
        sources.push(deep("", ".x", count));
        sources.push(deep("{", "}", count));
        sources.push(format!("void main() {{ {} }}", "{".repeat(count)));
        sources.push(format!("void main() {{ {} ; }}", "if (true) ".repeat(count)));
        sources.push(format!("void main() {{ {} ; }}", "if (true) ; else ".repeat(count)));
        sources.push(format!("{} int a; {}", "struct A { ".repeat(count), "};".repeat(count)));
        sources.push(format!("#if {}1{}\n#endif\n", "(".repeat(count), ")".repeat(count)));
        sources.push(format!("#define f(x) x\nfloat a = {}1{};", "f(".repeat(count), ")".repeat(count)));
        sources.push("#if 1\n".repeat(count));
        sources.push(format!("float{} a;", "[1]".repeat(count)));
    }
    // The stack of the page has this size.
    let thread = std::thread::Builder::new().stack_size(1 << 20).spawn(move || sources.iter().for_each(|s| process(s)));
    thread.expect("the thread starts").join().expect("no panic");
}

#[test]
fn endless_macros() {
    let mut doubling = String::from("#define a0 x\n");
    for i in 1..60 {
        doubling += &format!("#define a{i} a{} a{}\n", i - 1, i - 1);
    }
    let endless = "#define f(x) f(x) g(x)\n#define g(x) f(x f(x))\n#define A A B\n#define B A A\nint A = f(f(f(f(f(1))))); g(g(g(g(1))))\n";
    for source in [format!("{doubling}a59"), endless.to_string()] {
        process(&source);
    }
    let parsed = parse(&format!("{doubling}a59"));
    assert_eq!(parsed.problems[0].code, "macro-endless");
}

/// Work that grows faster than the source is abandoned. Without that, more would be found.
#[test]
fn work_that_grows_faster_than_the_source_is_abandoned() {
    // Each struct has two members of the previous one; the first has a member of an unknown type.
    let uniforms = |nested: usize| {
        let mut source = String::from("struct S0 { Unknown x; };\n");
        for i in 1..=nested {
            source += &format!("struct S{i} {{ S{} a, b; }};\n", i - 1);
        }
        let mut parsed = parse(&format!("{source}uniform S{nested} s; uniform float last; void main() {{}}"));
        leaves(&check(&mut parsed, Stage::Fragment).interface).len()
    };
    assert_eq!((uniforms(4), uniforms(20)), (1, 0));
    // A large array of a struct without known members.
    let mut parsed = parse("struct E { Unknown x; }; uniform E e[2000000]; uniform float last; void main() {}");
    assert_eq!(leaves(&check(&mut parsed, Stage::Fragment).interface).len(), 0);
    // Each call is compared with every overload.
    let wrong_calls = |functions: usize| {
        let calls = |i: usize| format!("float f(float a[{i}]) {{ return f(true); }}\n");
        let mut parsed = parse(&(1..=functions).map(calls).collect::<String>());
        check(&mut parsed, Stage::Fragment).problems.iter().filter(|problem| problem.code == "argument-types").count()
    };
    assert_eq!((wrong_calls(20), wrong_calls(150)), (20, 128));
}

#[test]
fn ten_megabytes() {
    let size = 10_000_000;
    for piece in [
        "a",
        "a ",
        ";",
        "(",
        "/*",
        "// c\n",
        "\0",
        "é",
        "float f() { return 1.0; }\n",
        "#define a b\n",
        "1.0+",
        "{",
        "\\\n",
    ] {
        let parsed = parse(&piece.repeat(size / piece.len()));
        assert!(parsed.problems.len() < 100, "{piece}: {}", parsed.problems.len());
    }
}
