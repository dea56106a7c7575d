//! The keywords of the format, their codes in binary files, and the contents of their rows.
//!
//! Names and codes: L. Maréchal, "The libMeshb library version 7" (INRIA), its table of keywords.

/// The contents of a keyword's rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rows {
    /// One integer, 2 or 3, without a count.
    Dimension,
    /// Coordinates and a reference.
    Vertices,
    /// The indices of `nodes` vertices, of which the first `corners` are the corners, and a reference.
    Surface { corners: usize, nodes: usize },
    /// Like surfaces, for a volume element.
    Volume { corners: usize, nodes: usize },
    /// The coordinates of a vector.
    Normals,
    /// The indices of a vertex and a normal.
    NormalAtVertices,
    /// A normal for each corner of the element with the same number, which has so many corners.
    NormalAtCorners(usize),
    /// Counted but not drawn.
    Counted,
    /// No count, not drawn.
    Bare,
    /// The end of the file.
    End,
}

#[derive(Debug)]
pub(super) struct Keyword {
    pub(super) name: &'static str,
    pub(super) code: u32,
    pub(super) rows: Rows,
}

const fn keyword(name: &'static str, code: u32, rows: Rows) -> Keyword {
    Keyword { name, code, rows }
}

const fn surface(corners: usize, nodes: usize) -> Rows {
    Rows::Surface { corners, nodes }
}

const fn volume(corners: usize, nodes: usize) -> Rows {
    Rows::Volume { corners, nodes }
}

/// All known keywords. `MeshVersionFormatted` is read before them.
pub(super) const KEYWORDS: &[Keyword] = &[
    keyword("Dimension", 3, Rows::Dimension),
    keyword("Vertices", 4, Rows::Vertices),
    keyword("Edges", 5, Rows::Counted),
    keyword("Triangles", 6, surface(3, 3)),
    keyword("Quadrilaterals", 7, surface(4, 4)),
    keyword("Tetrahedra", 8, volume(4, 4)),
    keyword("Prisms", 9, volume(6, 6)),
    keyword("Hexahedra", 10, volume(8, 8)),
    keyword("Corners", 13, Rows::Counted),
    keyword("Ridges", 14, Rows::Counted),
    keyword("RequiredVertices", 15, Rows::Counted),
    keyword("RequiredEdges", 16, Rows::Counted),
    keyword("RequiredTriangles", 17, Rows::Counted),
    keyword("RequiredQuadrilaterals", 18, Rows::Counted),
    keyword("TangentAtEdgeVertices", 19, Rows::Counted),
    keyword("NormalAtVertices", 20, Rows::NormalAtVertices),
    keyword("NormalAtTriangleVertices", 21, Rows::NormalAtCorners(3)),
    keyword("NormalAtQuadrilateralVertices", 22, Rows::NormalAtCorners(4)),
    keyword("AngleOfCornerBound", 23, Rows::Bare),
    keyword("TrianglesP2", 24, surface(3, 6)),
    keyword("EdgesP2", 25, Rows::Counted),
    keyword("QuadrilateralsQ2", 27, surface(4, 9)),
    keyword("SubDomainFromGeom", 29, Rows::Counted),
    keyword("TetrahedraP2", 30, volume(4, 10)),
    keyword("HexahedraQ2", 33, volume(8, 27)),
    keyword("Polyhedra", 46, Rows::Counted),
    keyword("Polygons", 47, Rows::Bare),
    keyword("Pyramids", 49, volume(5, 5)),
    keyword("BoundingBox", 50, Rows::Bare),
    keyword("End", 54, Rows::End),
    keyword("Tangents", 59, Rows::Counted),
    keyword("Normals", 60, Rows::Normals),
    keyword("TangentAtVertices", 61, Rows::Counted),
    keyword("SolAtVertices", 62, Rows::Counted),
    keyword("SolAtTriangles", 64, Rows::Counted),
    keyword("SolAtTetrahedra", 66, Rows::Counted),
    keyword("Iterations", 77, Rows::Bare),
    keyword("Time", 78, Rows::Bare),
    keyword("PrismsP2", 86, volume(6, 18)),
    keyword("PyramidsP2", 87, volume(5, 14)),
];

/// Finds a keyword by its name; programs differ in the case of its letters.
pub(super) fn by_name(name: &[u8]) -> Option<&'static Keyword> {
    KEYWORDS.iter().find(|keyword| keyword.name.as_bytes().eq_ignore_ascii_case(name))
}

pub(super) fn by_code(code: u32) -> Option<&'static Keyword> {
    KEYWORDS.iter().find(|keyword| keyword.code == code)
}
