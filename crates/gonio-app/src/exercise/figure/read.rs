//! Reads figures: the elements and attributes of SVG that the exercises' figures use.
//!
//! After W3C, *Scalable Vector Graphics (SVG) 2*, chapters 9 (paths), 10 (shapes) and 11 (text). Groups, transforms, styles and
//! nesting other than `tspan` are not supported. A test checks that the figures of all exercises are read completely.

use super::outline;
use egui::{Color32, Pos2, Rect, Vec2, pos2, vec2};

/// A figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its width and height, in its own units.
    pub size: Vec2,
    /// Its shapes, in painting order.
    pub shapes: Vec<FigureShape>,
}

/// A line around or along a shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Pen {
    /// Colour of the line.
    pub color: Color32,
    /// Width, in the figure's units.
    pub width: f32,
    /// Lengths of dashes and of gaps; `None` for a solid line.
    pub dashes: Option<[f32; 2]>,
}

/// A shape of a figure.
#[derive(Clone, Debug, PartialEq)]
pub enum FigureShape {
    /// Lines from point to point.
    Lines {
        /// At least two.
        points: Vec<Pos2>,
        /// The last is joined with the first.
        closed: bool,
        /// Colour of the inside.
        fill: Option<Color32>,
        /// The line.
        pen: Option<Pen>,
    },
    /// A rectangle.
    Rectangle {
        /// Position and size.
        rect: Rect,
        /// Radius of its corners.
        radius: f32,
        /// Colour of the inside.
        fill: Option<Color32>,
        /// The line around it.
        pen: Option<Pen>,
    },
    /// A circle.
    Circle {
        /// Its centre.
        center: Pos2,
        /// Radius of the circle.
        radius: f32,
        /// Colour of the inside.
        fill: Option<Color32>,
        /// The line around it.
        pen: Option<Pen>,
    },
    /// A line of text.
    Text(Text),
}

/// A line of text.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// A point of the baseline: its left end, middle or right end, by `anchor`.
    pub at: Pos2,
    /// 0 left, 0.5 the middle, 1 right.
    pub anchor: f32,
    /// Colour of the letters.
    pub color: Color32,
    /// The font.
    pub letters: Letters,
    /// Pieces, each with the step before it and its size.
    pub pieces: Vec<(Vec2, f32, String)>,
}

/// A style of letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Letters {
    /// Plain.
    Plain,
    /// Bold.
    Bold,
    /// Formulas.
    Math,
    /// Program code.
    Code,
}

/// Reads a figure. Unknown elements are skipped. Returns `None` if the file has no size.
pub fn figure(text: &str) -> Option<Figure> {
    let mut elements = Elements { rest: text };
    let svg = elements.next().filter(|element| element.name == "svg")?;
    let size = vec2(svg.number("width")?, svg.number("height")?);
    let color = svg.color("fill").unwrap_or(Color32::BLACK);
    let font_size = svg.number("font-size").unwrap_or(16.0);
    let mut shapes = Vec::new();
    while let Some(element) = elements.next() {
        if element.name == "text" {
            let inside = elements.until("</text>");
            shapes.extend(words(&element, inside, color, font_size).map(FigureShape::Text));
        } else {
            shapes.extend(shape(&element));
        }
    }
    Some(Figure { size, shapes })
}

fn shape(element: &Element<'_>) -> Option<FigureShape> {
    let number = |name| element.number(name);
    let (fill, pen) = (element.color("fill"), element.pen());
    let points = |text: &str| -> Option<Vec<Pos2>> {
        let pair = |pair: &str| {
            let (x, y) = pair.split_once(',')?;
            Some(pos2(x.parse().ok()?, y.parse().ok()?))
        };
        text.split_ascii_whitespace().map(pair).collect()
    };
    Some(match element.name {
        "line" => {
            let ends = vec![pos2(number("x1")?, number("y1")?), pos2(number("x2")?, number("y2")?)];
            FigureShape::Lines { points: ends, closed: false, fill: None, pen }
        }
        "polyline" | "polygon" => {
            FigureShape::Lines { points: points(element.get("points")?)?, closed: element.name == "polygon", fill, pen }
        }
        "path" => {
            let (points, closed) = outline::flattened(element.get("d")?)?;
            FigureShape::Lines { points, closed, fill, pen }
        }
        "rect" => {
            let min = pos2(number("x").unwrap_or(0.0), number("y").unwrap_or(0.0));
            let rect = Rect::from_min_size(min, vec2(number("width")?, number("height")?));
            FigureShape::Rectangle { rect, radius: number("rx").unwrap_or(0.0), fill, pen }
        }
        "circle" => FigureShape::Circle { center: pos2(number("cx")?, number("cy")?), radius: number("r")?, fill, pen },
        _ => return None,
    })
}

/// A `text` and the `tspan`s in it.
fn words(element: &Element<'_>, inside: &str, color: Color32, font_size: f32) -> Option<Text> {
    let family = element.get("font-family").unwrap_or_default();
    let letters = match element.number("font-weight") {
        _ if family.contains("Math") => Letters::Math,
        _ if family.contains("Mono") => Letters::Code,
        Some(weight) if weight >= 600.0 => Letters::Bold,
        _ => Letters::Plain,
    };
    let anchor = match element.get("text-anchor") {
        Some("middle") => 0.5,
        Some("end") => 1.0,
        _ => 0.0,
    };
    let size = element.number("font-size").unwrap_or(font_size);
    let mut pieces = Vec::new();
    let mut rest = inside;
    while !rest.is_empty() {
        let (before, after) = rest.split_once('<').unwrap_or((rest, ""));
        if !before.is_empty() {
            pieces.push((Vec2::ZERO, size, unescaped(before)));
        }
        let Some((attributes, after)) = after.split_once('>') else { break };
        let span = Element::new(attributes);
        let (words, after) = after.split_once("</tspan>").unwrap_or((after, ""));
        let step = vec2(span.number("dx").unwrap_or(0.0), span.number("dy").unwrap_or(0.0));
        pieces.push((step, span.number("font-size").unwrap_or(size), unescaped(words)));
        rest = after;
    }
    let at = pos2(element.number("x")?, element.number("y")?);
    Some(Text { at, anchor, color: element.color("fill").unwrap_or(color), letters, pieces })
}

fn unescaped(text: &str) -> String {
    text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&")
}

/// Iterates over the elements.
struct Elements<'a> {
    rest: &'a str,
}

impl<'a> Elements<'a> {
    /// The next start tag.
    fn next(&mut self) -> Option<Element<'a>> {
        loop {
            let (_, after) = self.rest.split_once('<')?;
            let (inside, after) = after.split_once('>')?;
            self.rest = after;
            if !inside.starts_with(['/', '?', '!']) {
                return Some(Element::new(inside));
            }
        }
    }

    /// The text before an end tag, which is skipped.
    fn until(&mut self, end: &str) -> &'a str {
        let (inside, after) = self.rest.split_once(end).unwrap_or((self.rest, ""));
        self.rest = after;
        inside
    }
}

/// An element's name and its attributes.
struct Element<'a> {
    name: &'a str,
    attributes: &'a str,
}

impl<'a> Element<'a> {
    fn new(inside: &'a str) -> Self {
        let inside = inside.trim_end_matches('/');
        let (name, attributes) = inside.split_once(char::is_whitespace).unwrap_or((inside, ""));
        Element { name, attributes }
    }

    fn get(&self, name: &str) -> Option<&'a str> {
        let mut rest = self.attributes;
        loop {
            let (key, after) = rest.split_once("=\"")?;
            let (value, after) = after.split_once('"')?;
            if key.trim() == name {
                return Some(value);
            }
            rest = after;
        }
    }

    fn number(&self, name: &str) -> Option<f32> {
        self.get(name)?.parse().ok()
    }

    fn color(&self, name: &str) -> Option<Color32> {
        let digits = self.get(name)?.strip_prefix('#')?;
        let number = u32::from_str_radix(digits, 16).ok()?;
        let [r, g, b] = match digits.len() {
            3 => [number >> 8, number >> 4, number].map(|digit| (digit & 15) * 17),
            6 => [number >> 16, number >> 8, number].map(|byte| byte & 255),
            _ => return None,
        };
        Some(Color32::from_rgb(r as u8, g as u8, b as u8))
    }

    fn pen(&self) -> Option<Pen> {
        let dashes = self.get("stroke-dasharray").and_then(|both| {
            let (dash, gap) = both.split_once(' ')?;
            Some([dash.parse().ok()?, gap.parse().ok()?])
        });
        Some(Pen { color: self.color("stroke")?, width: self.number("stroke-width").unwrap_or(1.0), dashes })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use gonio_exercises::exercise;

    #[test]
    fn elements_become_shapes() {
        let text = r##"<svg width="20" height="10" fill="#22292f" font-size="15"><title>a &lt; b</title>
            <rect width="20" height="10" rx="2" fill="#fff"/>
            <line x1="1" y1="2" x2="3" y2="4" stroke="#c8501e" stroke-width="2" stroke-dasharray="4 5"/>
            <polygon points="0,0 1,0 1,1" fill="none" stroke="#000"/>
            <text x="5" y="6" text-anchor="middle" font-weight="600">a &amp; b</text>
            <text x="1" y="2">n<tspan dx="3" dy="4" font-size="11">L</tspan> end</text></svg>"##;
        let figure = figure(text).unwrap();
        assert_eq!((figure.size, figure.shapes.len()), (vec2(20.0, 10.0), 5));
        let pen = |width, dashes, color| Some(Pen { color, width, dashes });
        let orange = pen(2.0, Some([4.0, 5.0]), Color32::from_rgb(0xc8, 0x50, 0x1e));
        assert_eq!(
            figure.shapes[1],
            FigureShape::Lines { points: vec![pos2(1.0, 2.0), pos2(3.0, 4.0)], closed: false, fill: None, pen: orange }
        );
        assert!(
            matches!(&figure.shapes[2], FigureShape::Lines { closed: true, fill: None, points, .. } if points.len() == 3)
        );
        let FigureShape::Text(bold) = &figure.shapes[3] else { panic!("{:?}", figure.shapes[3]) };
        assert_eq!((bold.anchor, bold.letters, bold.pieces[0].2.as_str()), (0.5, Letters::Bold, "a & b"));
        let FigureShape::Text(pieces) = &figure.shapes[4] else { panic!("{:?}", figure.shapes[4]) };
        let sizes: Vec<(f32, &str)> = pieces.pieces.iter().map(|(_, size, words)| (*size, words.as_str())).collect();
        assert_eq!((sizes, pieces.pieces[1].0), (vec![(15.0, "n"), (11.0, "L"), (15.0, " end")], vec2(3.0, 4.0)));
    }

    #[test]
    fn every_element_of_every_figure_is_read() {
        let mut figures = 0;
        for exercise in exercise::all() {
            for (name, text) in exercise.start_files().filter(|(name, _)| name.ends_with(".svg")) {
                let figure = figure(text).unwrap_or_else(|| panic!("{name} has no size"));
                let elements = ["<line ", "<rect ", "<circle ", "<path ", "<polygon ", "<polyline ", "<text "];
                let count: usize = elements.iter().map(|element| text.matches(element).count()).sum();
                assert_eq!(figure.shapes.len(), count, "{name}");
                // Unknown elements would be skipped silently.
                let known =
                    ["svg", "title", "desc", "tspan", "line", "rect", "circle", "path", "polygon", "polyline", "text"];
                for element in text.split('<').skip(1).filter(|part| !part.starts_with('/')) {
                    let element = element.split([' ', '>']).next().unwrap();
                    assert!(known.contains(&element), "{name}: {element}");
                }
                for word in [" transform=", " style=", " class=", "opacity"] {
                    assert!(!text.contains(word), "{name}: {word}");
                }
                figures += 1;
            }
        }
        assert!(figures >= 10, "{figures}");
    }
}
