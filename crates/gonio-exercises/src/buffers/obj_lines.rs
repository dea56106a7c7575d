//! The lines of an OBJ file, before any index is resolved: the input of correct and wrong readers.

use super::cut;

/// `v`, `vt` and `vn` indices of a corner as written; `None` if the slot is empty.
pub(super) type Slots = [Option<i64>; 3];

/// A face as written.
#[derive(Clone, Debug)]
pub(super) struct Face {
    /// Line, from 1.
    pub(super) line: u64,
    pub(super) corners: Vec<Slots>,
    /// Number of `v`, `vt` and `vn` lines before it.
    pub(super) before: [usize; 3],
    /// Number of the object that it belongs to.
    pub(super) object: usize,
    /// Its triangles as a correct reader cuts them, with corners counted from 0.
    pub(super) cut: Vec<[usize; 3]>,
    /// Whether it is convex, so that all triangulations are equivalent.
    pub(super) is_convex: bool,
}

/// The lines of an OBJ file.
#[derive(Clone, Debug, Default)]
pub(super) struct ObjLines {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) tex_coords: Vec<[f32; 2]>,
    /// Normals as written, of any length.
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) faces: Vec<Face>,
    /// For each object, the number of `v`, `vt` and `vn` lines before it.
    pub(super) objects: Vec<[usize; 3]>,
    /// The numbers and texts of lines with faces.
    pub(super) lines: Vec<(u64, String)>,
}

/// Maximum number of characters of a line that are kept.
const MOST_LETTERS: usize = 200;

impl ObjLines {
    /// Reads known lines and skips the rest: [`gonio_mesh::obj::read`] has validated the file.
    pub(super) fn parse(bytes: &[u8]) -> Self {
        let text = String::from_utf8_lossy(bytes);
        let mut source = ObjLines::default();
        // Objects are `o`, or `g` in files that have no `o`.
        let has_objects = text.lines().any(|line| line.split_whitespace().next() == Some("o"));
        for (number, line) in (1..).zip(text.lines()) {
            let line = line.split('#').next().unwrap_or_default();
            let mut words = line.split_whitespace();
            match words.next() {
                Some("v") => source.positions.push(numbers(words)),
                Some("vt") => source.tex_coords.push(numbers(words)),
                Some("vn") => source.normals.push(numbers(words)),
                Some("f") => source.face(number, line, words),
                Some(keyword) if keyword == if has_objects { "o" } else { "g" } => {
                    let counts = source.counts();
                    source.objects.push(counts);
                }
                _ => {}
            }
        }
        for face in &mut source.faces {
            let corner = |slots: &Slots| {
                let index = slots[0]?;
                let place = if index > 0 { index.checked_sub(1)? } else { face.before[0] as i64 + index };
                source.positions.get(usize::try_from(place).ok()?).copied()
            };
            let points: Option<Vec<[f32; 3]>> = face.corners.iter().map(corner).collect();
            (face.cut, face.is_convex) = cut::polygon(&points.unwrap_or_default());
        }
        source
    }

    fn counts(&self) -> [usize; 3] {
        [self.positions.len(), self.tex_coords.len(), self.normals.len()]
    }

    fn face<'a>(&mut self, line: u64, text: &str, words: impl Iterator<Item = &'a str>) {
        let slot = |word: &str| if word.is_empty() { Ok(None) } else { word.parse().map(Some) };
        let corner = |word: &str| {
            let mut slots = [None; 3];
            for (place, part) in slots.iter_mut().zip(word.split('/')) {
                *place = slot(part).ok()?;
            }
            slots[0].is_some().then_some(slots)
        };
        if let Some(corners) = words.map(corner).collect::<Option<Vec<Slots>>>().filter(|corners| corners.len() >= 3) {
            self.lines.push((line, text.trim().chars().take(MOST_LETTERS).collect()));
            let (before, object) = (self.counts(), self.objects.len());
            self.faces.push(Face { line, corners, before, object, cut: Vec::new(), is_convex: true });
        }
    }

    /// The text of a line with a face.
    pub(super) fn line(&self, number: u64) -> Option<&str> {
        let place = self.lines.binary_search_by_key(&number, |(line, _)| *line).ok()?;
        Some(&self.lines[place].1)
    }

    /// Number of lines of each attribute before an object's first line.
    pub(super) fn start_of(&self, object: usize) -> [usize; 3] {
        object.checked_sub(1).and_then(|place| self.objects.get(place)).copied().unwrap_or_default()
    }
}

fn numbers<'a, const N: usize>(mut words: impl Iterator<Item = &'a str>) -> [f32; N] {
    std::array::from_fn(|_| words.next().and_then(|word| word.parse().ok()).unwrap_or(0.0))
}
