//! The mistakes that are known, each with the readers that make it.

use super::reader::{Axes, From, Negative, Numbers, Order, Polygons, Reader, SlotUse, Which};
use serde::Serialize;

/// A mistake, in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct MistakeName {
    /// Stable, in kebab-case.
    pub id: &'static str,
    /// The title.
    pub name: &'static str,
    /// What the program does, and the consequence.
    pub explanation: &'static str,
    /// The change that fixes it.
    pub how_to_fix: &'static str,
}

/// A mistake with the readers that make it: the switch it sets, in each of the ways it is usually made.
pub(super) struct Mistake {
    pub(super) words: MistakeName,
    pub(super) variants: &'static [fn(&mut Reader)],
    /// A peculiarity that is fine as long as the rest of the program knows of it.
    pub(super) is_harmless: bool,
}

/// All mistakes that a buffer can be recognised to have, the likely ones first.
pub fn names() -> impl Iterator<Item = MistakeName> {
    MISTAKES.iter().map(|mistake| mistake.words)
}

/// A reader that makes mistakes.
#[derive(Clone, Debug)]
pub(super) struct WrongReader {
    /// Places in [`MISTAKES`], rising.
    pub(super) mistakes: Vec<usize>,
    pub(super) reader: Reader,
}

/// Every variant of every mistake alone, with both ways of cutting polygons.
pub(super) fn singles() -> Vec<WrongReader> {
    let variants = |(number, mistake): (usize, &Mistake)| -> Vec<WrongReader> {
        let made = mistake.variants.iter().map(|variant| {
            let mut reader = Reader::default();
            variant(&mut reader);
            WrongReader { mistakes: vec![number], reader }
        });
        made.collect()
    };
    with_other_diagonals(MISTAKES.iter().enumerate().flat_map(variants).collect())
}

/// Two mistakes at once, where neither hides the other: both switches can be set.
pub(super) fn pairs(allowed: impl Fn(usize, usize) -> bool) -> Vec<WrongReader> {
    let mut pairs = Vec::new();
    for (first, a) in MISTAKES.iter().enumerate() {
        for (second, b) in MISTAKES.iter().enumerate().skip(first + 1).filter(|(second, _)| allowed(first, *second)) {
            for variant_a in a.variants {
                for variant_b in b.variants {
                    let [mut ab, mut ba] = [Reader::default(), Reader::default()];
                    variant_a(&mut ab);
                    let only_a = ab.clone();
                    variant_b(&mut ab);
                    variant_b(&mut ba);
                    let only_b = ba.clone();
                    variant_a(&mut ba);
                    if ab == ba && ab != only_a && ab != only_b {
                        pairs.push(WrongReader { mistakes: vec![first, second], reader: ab });
                    }
                }
            }
        }
    }
    with_other_diagonals(pairs)
}

/// A student may well cut a quad along the other diagonal, and make a mistake besides.
fn with_other_diagonals(readers: Vec<WrongReader>) -> Vec<WrongReader> {
    let others: Vec<WrongReader> = readers
        .iter()
        .filter(|wrong| wrong.reader.polygons == Default::default() && wrong.reader.order == Default::default())
        .map(|wrong| {
            let reader = Reader { other_diagonals: true, ..wrong.reader.clone() };
            WrongReader { mistakes: wrong.mistakes.clone(), reader }
        })
        .collect();
    readers.into_iter().chain(others).collect()
}

const fn mistake(
    id: &'static str,
    name: &'static str,
    explanation: &'static str,
    how_to_fix: &'static str,
    variants: &'static [fn(&mut Reader)],
) -> Mistake {
    Mistake { words: MistakeName { id, name, explanation, how_to_fix }, variants, is_harmless: false }
}

/// The likely ones first: where two explain a buffer equally well, the first is named.
pub(super) static MISTAKES: [Mistake; 38] = [
    mistake(
        "indices-from-0",
        "Indices are treated as counting from 0",
        "An OBJ file counts its vertices, texture coordinates and normals from 1. Used as indices into an array that \
         starts at 0, each one is off by one, and the last one is out of range.",
        "Subtract 1 from each index before you use it.",
        &[|r| r.from_zero = [true; 3]],
    ),
    mistake(
        "tex-coord-and-normal-swapped",
        "vt and vn are swapped in f",
        "The corners of a face are v/vt/vn, in this order. Here the second number leads into the normals and the third \
         into the texture coordinates.",
        "Take the second number of a corner for vt, the third for vn.",
        &[|r| r.slots = SlotUse::Swapped],
    ),
    Mistake {
        is_harmless: true,
        ..mistake(
            "v-flipped",
            "v is 1 - v",
            "v runs from the bottom to the top in an OBJ file, and here from the top down. That is right if pictures are \
             loaded with their first row first and not flipped; otherwise textures are upside down.",
            "Pass v to OpenGL as in the file and flip the picture when loading it, \
             stbi_set_flip_vertically_on_load(true); or keep it so, but do only one of the two.",
            &[|r| r.flip_v = true],
        )
    },
    mistake(
        "quads-first-triangle-only",
        "Only the first triangle of each polygon",
        "A face with four corners is two triangles. Here only its first three corners are read, so that half of each quad \
         is missing.",
        "Make a triangle of corners 1, i and i + 1 for each i from 2 to the last but one.",
        &[|r| r.polygons = Polygons::FirstTriangle],
    ),
    mistake(
        "quads-lost",
        "Faces with more than three corners are left out",
        "Only the faces that are triangles arrive in the buffer; quads and larger polygons are missing.",
        "Cut polygons into triangles: corners 1, i, i + 1.",
        &[|r| r.polygons = Polygons::Lost],
    ),
    mistake(
        "quads-as-triangles",
        "Corner 4 of a quad starts the next triangle",
        "All corners of all faces form one list, and every three are drawn as a triangle. After the first quad the \
         triangles join corners of different faces.",
        "Finish each line f by itself: cut it into triangles before reading the next one.",
        &[|r| r.polygons = Polygons::Stream],
    ),
    mistake(
        "large-polygons-cut-short",
        "Only the first four corners of larger polygons",
        "Triangles and quads are right, but of a face with five corners or more only the first four are read.",
        "Read corners until the line ends, and cut any number of them into triangles.",
        &[|r| r.polygons = Polygons::FirstQuad],
    ),
    mistake(
        "large-polygons-lost",
        "Faces with more than four corners are left out",
        "Triangles and quads arrive in the buffer; faces with five corners or more are missing.",
        "Read corners until the line ends, and cut any number of them into triangles.",
        &[|r| r.polygons = Polygons::LargeLost],
    ),
    mistake(
        "concave-polygon-as-fan",
        "A concave polygon is cut as a fan",
        "Triangles of corners 1, i, i + 1 cover a polygon only if it has no corner that points inwards. Here some lie outside of \
         it, turned over.",
        "Cut ears: a corner that turns outwards and whose triangle holds no other corner. Or triangulate in \
         Blender's export.",
        &[|r| r.polygons = Polygons::Fan],
    ),
    mistake(
        "normals-by-position",
        "Normals are looked up by the position's index",
        "The corner v/vt/vn says which normal it has. Here the first number is used for the normal as well, so that a \
         position always has the normal of the same number.",
        "Use the third number of a corner as the place in the list of vn.",
        &[|r| r.normal = From::Position],
    ),
    mistake(
        "tex-coords-by-position",
        "Texture coordinates are looked up by the position's index",
        "The corner v/vt/vn says which texture coordinate it has. Here the first number is used for it as well.",
        "Use the second number of a corner as the place in the list of vt.",
        &[|r| r.tex_coord = From::Position],
    ),
    mistake(
        "vertices-not-split",
        "One texture coordinate and one normal for each position",
        "A position that belongs to several faces may have another normal and texture coordinate in each. Here they are \
         stored by position, and one corner's values replace those of all others.",
        "Make a vertex for each different v/vt/vn, not for each v (or simply one for each corner).",
        &[|r| r.unsplit = Some(Which::Last), |r| r.unsplit = Some(Which::First)],
    ),
    mistake(
        "normals-missing",
        "The normals are not the file's: all are the same",
        "The file has normals, but every vertex of the buffer has the same one, or zero.",
        "Read the lines vn and give each corner the one that its third number names.",
        &[
            |r| r.normal = From::Constant([0.0; 3]),
            |r| r.normal = From::Constant([0.0, 0.0, 1.0]),
            |r| r.normal = From::Constant([0.0, 1.0, 0.0]),
        ],
    ),
    mistake(
        "tex-coords-missing",
        "The texture coordinates are not the file's: all are zero",
        "The file has texture coordinates, but every vertex of the buffer has (0, 0).",
        "Read the lines vt and give each corner the one that its second number names.",
        &[|r| r.tex_coord = From::Constant([0.0; 3])],
    ),
    mistake(
        "negative-as-positive",
        "The sign of negative indices is lost",
        "-1 means the latest vertex before the line, -2 the one before it. Here the minus is dropped and the index counts \
         from the start.",
        "If an index is negative, add it to the number of vertices (or vt, or vn) read so far.",
        &[|r| r.negative = Negative::Positive],
    ),
    mistake(
        "negative-faces-lost",
        "Faces with negative indices are left out",
        "-1 means the latest vertex before the line. The faces that use it are missing here.",
        "If an index is negative, add it to the number of vertices (or vt, or vn) read so far.",
        &[|r| r.negative = Negative::FacesLost],
    ),
    mistake(
        "negative-from-the-end-of-the-file",
        "Negative indices count from the end of the file",
        "-1 means the latest vertex before the line f, not the last one of the whole file. Here the faces are joined after \
         everything was read, with the lists' final lengths.",
        "Turn a negative index into a positive one while reading its line: add the number of vertices so far, plus 1.",
        &[|r| r.negative = Negative::FromEnd],
    ),
    mistake(
        "negative-one-too-far",
        "1 is taken away from negative indices too",
        "Positive indices count from 1 and need 1 taken away; negative ones count back from the end and need none. Here -1 \
         leads to the last but one.",
        "Subtract 1 from positive indices only.",
        &[|r| r.negative = Negative::OneTooFar],
    ),
    mistake(
        "normal-indices-from-0",
        "Only the indices of normals are treated as counting from 0",
        "Positions are right, but the normals' index is used without taking 1 away: each corner has the next normal.",
        "Subtract 1 from the third number of a corner too.",
        &[|r| r.from_zero[2] = true],
    ),
    mistake(
        "tex-coord-indices-from-0",
        "Only the indices of texture coordinates are treated as counting from 0",
        "Positions are right, but the texture coordinates' index is used without taking 1 away: each corner has the next \
         one.",
        "Subtract 1 from the second number of a corner too.",
        &[|r| r.from_zero[1] = true],
    ),
    mistake(
        "position-indices-from-0",
        "Only the indices of positions are treated as counting from 0",
        "Texture coordinates and normals are right, but the positions' index is used without taking 1 away.",
        "Subtract 1 from the first number of a corner too.",
        &[|r| r.from_zero[0] = true],
    ),
    mistake(
        "u-and-v-swapped",
        "u and v are swapped",
        "A line vt is u, then v. Here they are swapped in the buffer, and textures appear on their sides.",
        "Write the first number of vt first.",
        &[|r| r.swap_uv = true],
    ),
    mistake(
        "y-and-z-swapped",
        "y and z are swapped",
        "The buffer has x, z, y: the model lies on its back, mirrored, so that its inside is visible.",
        "Write the numbers of v and vn in the file's order. To turn a model use the model matrix.",
        &[|r| r.axes = Axes::SwappedYz],
    ),
    mistake(
        "turned-to-z-up",
        "The model is turned: x, z, -y",
        "The buffer has the file's model turned by a quarter around x, as programs do where z points up.",
        "Write the numbers of v and vn in the file's order. To turn a model use the model matrix.",
        &[|r| r.axes = Axes::ZUp],
    ),
    mistake(
        "winding-reversed",
        "Triangles have the opposite winding",
        "The corners of a face are counter-clockwise seen from the front. Here each triangle has two of them swapped: \
         with face culling its front is not drawn.",
        "Keep the corners' order: 1, i, i + 1.",
        &[|r| r.turned_over = true],
    ),
    mistake(
        "faces-ignored",
        "The faces are ignored: v, vt and vn are in the file's order",
        "The lists v, vt and vn are combined by position. The f lines define which of them belong together, and \
         which three form a triangle.",
        "For each corner of each line f, append the position, texture coordinate and normal that it names.",
        &[|r| r.order = Order::FacesIgnored],
    ),
    mistake(
        "indices-not-applied",
        "Each distinct vertex is in the buffer once, without its indices",
        "These are the vertices for glDrawElements, without the element indices that join them to triangles.",
        "Write one row for each corner of each triangle, or hand in JSON with \"vertices\" and \"indices\".",
        &[|r| r.order = Order::EachOnce],
    ),
    mistake(
        "one-normal-per-face",
        "All corners of a face have its first corner's normal",
        "Each corner names its own normal. Here the first corner's is used for the whole face, and round models get \
         facets.",
        "Use the third number of each corner.",
        &[|r| r.normal = From::FirstCorner],
    ),
    mistake(
        "normals-computed",
        "Normals are computed from the triangles",
        "The normals are those of the flat triangles and not the file's: round models get facets.",
        "Read the lines vn. Compute normals only for files that have none.",
        &[|r| r.normal = From::Geometry],
    ),
    mistake(
        "last-object-only",
        "Only the last object is read",
        "A file may hold several objects (lines o). Only the last one's faces are in the buffer: what was read before is \
         forgotten at each o.",
        "Do not empty your lists at a line o.",
        &[|r| r.objects = Some(Which::Last)],
    ),
    mistake(
        "first-object-only",
        "Only the first object is read",
        "A file may hold several objects (lines o). Only the first one's faces are in the buffer.",
        "Read on after the second line o.",
        &[|r| r.objects = Some(Which::First)],
    ),
    mistake(
        "indices-anew-in-each-object",
        "Indices restart in each object",
        "Indices count through the whole file, objects or not. Here they are added to the place where the object's own \
         vertices begin.",
        "Do not start counting again at a line o.",
        &[|r| r.anew = true],
    ),
    mistake(
        "first-lines-skipped",
        "The first line of each kind is skipped",
        "The first v, vt, vn and f are missing: everything is one place off, and one face is lost.",
        "Check how your loop starts: a line is read before it, or the first element is skipped.",
        &[|r| r.skips_first = true],
    ),
    mistake(
        "last-face-lost",
        "The last face is missing",
        "All faces but the last are in the buffer: the loop ends one too early, or needs a line end after the last \
         line.",
        "Handle a line before asking whether there is another: while (std::getline(file, line)).",
        &[|r| r.loses_last_face = true],
    ),
    mistake(
        "numbers-truncated",
        "Numbers lose their fraction",
        "0.625 arrives as 0. The numbers are read as whole ones (int, atoi), or by a function that expects a decimal comma \
         and stops at the point.",
        "Read floats, and set no locale of your own: setlocale(LC_NUMERIC, \"C\"), std::locale::classic().",
        &[|r| r.numbers = Numbers::Truncated],
    ),
    mistake(
        "decimal-comma",
        "Reading stops at the first decimal point of a line",
        "Of each line only the whole part of its first number arrives, the rest is 0: the stream expects a decimal comma, as \
         French, Dutch and German settings have it, or is read into whole numbers.",
        "Use file.imbue(std::locale::classic()) before reading, and floats.",
        &[|r| r.numbers = Numbers::StoppedAtPoint],
    ),
    mistake(
        "empty-slot-passed-over",
        "v//vn is read as v/vt",
        "Where a corner is v//vn, its second slot is empty. Here empty slots vanish when the corner is split, and the normal's \
         index is used for the texture coordinate's.",
        "Split at each `/` and keep empty parts.",
        &[|r| r.slots = SlotUse::EmptyPassedOver],
    ),
    mistake(
        "short-corners-lost",
        "Faces whose corners are not v/vt/vn are left out",
        "A corner may also be v, v/vt or v//vn. Faces written so are missing: \"%d/%d/%d\" does not match them.",
        "Split corners at `/` and look how many parts there are, and which are empty.",
        &[|r| r.loses_partial = true],
    ),
];
