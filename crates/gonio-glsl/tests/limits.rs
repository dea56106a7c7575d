//! Shaders that exceed a limit are rejected with the line; large shaders within all limits are accepted.

mod hostile;

use gonio_glsl::{Limit, LoopBound, OutputVersion, Stage, check, check_pair, leaves, parse, translate_bounded};
use hostile::{Pair, pairs};

/// Parses, checks and translates a pair. Returns the limits that it exceeds, with their lines.
fn read(pair: &Pair) -> Vec<(Limit, u32)> {
    let mut refused = Vec::new();
    let mut both = Vec::new();
    for (source, stage) in [(&pair.vertex, Stage::Vertex), (&pair.fragment, Stage::Fragment)] {
        let mut parsed = parse(source);
        let checked = check(&mut parsed, stage);
        for target in [OutputVersion::Core330, OutputVersion::Es300] {
            assert!(!translate_bounded(&parsed, &checked, target, Some(LoopBound::STUDENTS)).text.is_empty());
        }
        assert!(leaves(&checked.interface).len() < 10_000, "{}", pair.name);
        assert!(format!("{parsed:?}").len() > 9 && parsed.clone().unit == parsed.unit, "{}", pair.name);
        let refusal = parsed.refusal().or(checked.refusal());
        refused.extend(refusal.and_then(|problem| Some((problem.limit?, problem.span.line))));
        both.push(checked);
    }
    let _ = check_pair(&both[0], &both[1]);
    refused
}

/// Runs on a stack of 1 MiB, as small as that of the page.
fn on_small_stack<T: Send + 'static>(job: impl FnOnce() -> T + Send + 'static) -> T {
    let thread = std::thread::Builder::new().stack_size(1 << 20).spawn(job).expect("the thread starts");
    thread.join().expect("no panic and no overflow")
}

#[test]
fn every_limit_is_reported_with_its_line() {
    let results = on_small_stack(|| pairs().iter().map(|pair| (pair.name, pair.limit, read(pair))).collect::<Vec<_>>());
    assert!(results.len() >= 60, "{}", results.len());
    let is_right = |(_, limit, refused): &&(&str, Option<Limit>, Vec<(Limit, u32)>)| match refused.as_slice() {
        [] => limit.is_none(),
        [(found, line)] => Some(*found) == *limit && *line > 1,
        _ => false,
    };
    let wrong: Vec<_> = results.iter().filter(|pair| !is_right(pair)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn every_limit_is_exceeded_by_some_pair() {
    use Limit::*;
    let all = [
        Bytes,
        Tokens,
        Name,
        Macros,
        Nested,
        StructsNested,
        ArraySizes,
        Components,
        UnknownSize,
        InterfaceComponents,
        AllComponents,
        Variables,
        Functions,
        CallsNested,
        Inlined,
        LoopsNested,
        Cases,
        SyntaxErrors,
    ];
    let pairs = pairs();
    for limit in all {
        assert!(pairs.iter().any(|pair| pair.limit == Some(limit)), "{limit:?}");
        assert!(!limit.to_string().ends_with('.') && limit.to_string().len() > 20, "{limit}");
    }
}
