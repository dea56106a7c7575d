//! Files that try to use too much memory or time.

use super::summary::check;
use super::{documents, read, scene};
use gonio_mesh::{Limits, NoSidecars, collada};

#[test]
fn limits_are_kept() {
    let text = scene(&"<node><instance_geometry url=\"#g\"/></node>".repeat(3));
    let message = |limits| collada::read(text.as_bytes(), &mut NoSidecars, &limits).unwrap_err().message;
    let few_triangles = Limits { max_triangles: 2, ..Limits::default() };
    assert_eq!(message(few_triangles), "contains more than 2 triangles, which is the limit");
    let few_vertices = Limits { max_vertices: 8, ..Limits::default() };
    assert_eq!(message(few_vertices), "needs more than 8 vertices, which is the limit");
    let enough = Limits { max_vertices: 9, max_triangles: 3, ..Limits::default() };
    assert_eq!(collada::read(text.as_bytes(), &mut NoSidecars, &enough).unwrap().mesh.triangle_count(), 3);
    let few_bytes = Limits { max_bytes: 1000, ..Limits::default() };
    let message = message(few_bytes);
    assert!(
        message.starts_with("contains more than ") && message.ends_with(" elements, which is the limit"),
        "{message}"
    );
}

/// A polygon is looked at as a whole.
#[test]
fn a_polygon_has_a_most_of_corners() {
    let text = scene("<node><instance_geometry url=\"#g\"/></node>");
    let with = |corners: usize| {
        let p = format!("<vcount>{corners}</vcount><p>{}</p>", "0 ".repeat(corners));
        text.replace("<p>0 1 2</p>", &p).replace("<triangles", "<polylist").replace("</triangles", "</polylist")
    };
    let message = read(with(4_194_305).as_bytes()).unwrap_err().to_string();
    assert!(message.contains("polygon 0 has more than 4194304 corners, which is the limit"), "{message}");
    assert_eq!(read(with(5).as_bytes()).unwrap().mesh.triangle_count(), 3);
}

/// Neither the parser nor anything after it calls itself once for each level.
#[test]
fn deep_nesting_is_refused() {
    let text = format!("<COLLADA version=\"1.4.1\">{}", "<node>".repeat(1_000_000));
    let message = read(text.as_bytes()).unwrap_err().to_string();
    assert_eq!(message, "1:3092: elements are nested deeper than 512, which is the limit");
    let closed = format!("{text}{}</COLLADA>", "</node>".repeat(1_000_000));
    assert!(read(closed.as_bytes()).is_err());
    // What is not so deep is read.
    let text = scene(&format!("{}<instance_geometry url=\"#g\"/>{}", "<node>".repeat(500), "</node>".repeat(500)));
    assert_eq!(read(text.as_bytes()).unwrap().mesh.triangle_count(), 1);
}

/// Ten entities of ten entities each, ten times over.
#[test]
fn entities_do_not_expand() {
    let mut text = String::from("<!DOCTYPE c [<!ENTITY e0 \"0 0 0 0 0 0 0 0 0 0 \">");
    for level in 1..10 {
        let ten = format!("&e{};", level - 1).repeat(10);
        text.push_str(&format!("<!ENTITY e{level} \"{ten}\">"));
    }
    text.push_str("]>\n<COLLADA><float_array>&e9;</float_array></COLLADA>");
    let message = read(text.as_bytes()).unwrap_err().to_string();
    assert_eq!(message, "2:23: the entity \"e9\" is not predefined in XML: it is not expanded");
}

/// Forty nodes, each of which places the next one twice: a million million triangles.
#[test]
fn nodes_do_not_multiply_without_end() {
    let twice = |i: usize| {
        let next = format!("<instance_node url=\"#n{}\"/>", i + 1).repeat(2);
        format!("<node id=\"n{i}\">{next}</node>")
    };
    let nodes: String = (0..40).map(twice).collect();
    let text = scene(&format!("{nodes}<node id=\"n40\"><instance_geometry url=\"#g\"/></node>"));
    let limits = Limits { max_bytes: 1 << 20, ..Limits::default() };
    let message = collada::read(text.as_bytes(), &mut NoSidecars, &limits).unwrap_err().message;
    assert_eq!(message, "the placed geometries take more than 1048576 bytes, which is the limit");
    let text = scene(&format!("{nodes}<node id=\"n40\"/>"));
    let message = read(text.as_bytes()).unwrap_err().message;
    let expected =
        "nodes are instantiated so often that more than 2000000 elements would be visited, which is the limit";
    assert_eq!(message, expected);
}

#[test]
fn counts_are_not_believed() {
    let text =
        String::from_utf8(documents().into_iter().find(|(name, _)| name == "primitives.dae").unwrap().1).unwrap();
    let base = read(text.as_bytes()).unwrap().diagnostics;
    let lines = text.find("<linestrips").unwrap()..text.find("</linestrips").unwrap();
    for huge in ["18446744073709551615", "4294967296", "9223372036854775807"] {
        for name in ["count", "stride", "offset"] {
            for (at, _) in text.match_indices(&format!("{name}=\"")) {
                let start = at + name.len() + 2;
                let end = start + text[start..].find('"').unwrap();
                let changed = format!("{}{huge}{}", &text[..start], &text[end..]);
                if let Ok(model) = read(changed.as_bytes()) {
                    check(&model);
                    // Lines are only counted.
                    let is_told = !lines.contains(&at);
                    assert_eq!(model.diagnostics != base, is_told, "{changed}");
                }
            }
        }
    }
}

/// Many attributes in one element take no longer than as many in many.
#[test]
fn many_attributes_are_read() {
    let attributes: String = (0..100_000).map(|i| format!(" a{i}=\"\"")).collect();
    let text = scene(&format!("<node{attributes}><instance_geometry url=\"#g\"/></node>"));
    assert_eq!(read(text.as_bytes()).unwrap().mesh.triangle_count(), 1);
}
