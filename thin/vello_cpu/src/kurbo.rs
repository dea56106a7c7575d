//! Paths of lines and Bézier curves, with the names of the crate `kurbo`. Lengths are in pixels.

/// A point.
pub type Point = (f64, f64);

/// Largest distance of a chord from its curve, in pixels. A twentieth changes a pixel's coverage by at most that much, and
/// a glyph's curves are seldom longer than ten pixels.
const TOLERANCE: f64 = 0.05;
/// Most chords of a curve: more than any glyph needs, as a limit for broken fonts.
const MOST_CHORDS: f64 = 256.0;

/// A translation. (Paths arrive scaled and rotated.)
#[derive(Clone, Copy, Debug, Default)]
pub struct Affine {
    by: Point,
}

impl Affine {
    /// Translates by a vector.
    pub fn translate(by: Point) -> Self {
        Affine { by }
    }

    fn of(self, point: Point) -> Point {
        (point.0 + self.by.0, point.1 + self.by.1)
    }
}

/// An axis-aligned rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Left edge.
    pub x0: f64,
    /// Top edge.
    pub y0: f64,
    /// Right edge.
    pub x1: f64,
    /// Bottom edge.
    pub y1: f64,
}

impl Rect {
    /// The smallest rectangle of whole pixels that contains this one.
    pub fn expand(self) -> Rect {
        Rect { x0: self.x0.floor(), y0: self.y0.floor(), x1: self.x1.ceil(), y1: self.y1.ceil() }
    }

    /// The width.
    pub fn width(&self) -> f64 {
        self.x1 - self.x0
    }

    /// The height.
    pub fn height(&self) -> f64 {
        self.y1 - self.y0
    }
}

enum Step {
    Move(Point),
    Line(Point),
    Quad(Point, Point),
    Cubic(Point, Point, Point),
    Close,
}

/// A path.
#[derive(Default)]
pub struct BezPath {
    steps: Vec<Step>,
}

impl BezPath {
    /// An empty path.
    pub fn new() -> Self {
        BezPath::default()
    }

    /// Begins a contour.
    pub fn move_to(&mut self, to: Point) {
        self.steps.push(Step::Move(to));
    }

    /// Adds a straight line.
    pub fn line_to(&mut self, to: Point) {
        self.steps.push(Step::Line(to));
    }

    /// Adds a quadratic curve.
    pub fn quad_to(&mut self, control: Point, to: Point) {
        self.steps.push(Step::Quad(control, to));
    }

    /// Adds a cubic curve.
    pub fn curve_to(&mut self, first: Point, second: Point, to: Point) {
        self.steps.push(Step::Cubic(first, second, to));
    }

    /// Closes a contour.
    pub fn close_path(&mut self) {
        self.steps.push(Step::Close);
    }

    /// The bounding rectangle of all points and control points, which contains the curves; zero for an empty path.
    pub fn control_box(&self) -> Rect {
        let mut bounds: Option<Rect> = None;
        let mut add = |(x, y): Point| {
            let r = bounds.get_or_insert(Rect { x0: x, y0: y, x1: x, y1: y });
            *r = Rect { x0: r.x0.min(x), y0: r.y0.min(y), x1: r.x1.max(x), y1: r.y1.max(y) };
        };
        for step in &self.steps {
            match *step {
                Step::Move(a) | Step::Line(a) => add(a),
                Step::Quad(a, b) => [a, b].into_iter().for_each(&mut add),
                Step::Cubic(a, b, c) => [a, b, c].into_iter().for_each(&mut add),
                Step::Close => {}
            }
        }
        bounds.unwrap_or(Rect { x0: 0.0, y0: 0.0, x1: 0.0, y1: 0.0 })
    }

    /// Its edges as straight lines, moved by `transform`; each contour is closed.
    pub(crate) fn flatten(&self, transform: Affine, mut line: impl FnMut(Point, Point)) {
        let (mut start, mut at) = ((0.0, 0.0), (0.0, 0.0));
        for step in &self.steps {
            match *step {
                Step::Move(to) => {
                    line(at, start);
                    start = transform.of(to);
                    at = start;
                }
                Step::Line(to) => {
                    let to = transform.of(to);
                    line(at, to);
                    at = to;
                }
                Step::Quad(control, to) => {
                    // The same curve as a cubic.
                    let (c, to) = (transform.of(control), transform.of(to));
                    let (first, second) = (between(at, c, 2.0 / 3.0), between(to, c, 2.0 / 3.0));
                    chords(at, first, second, to, &mut line);
                    at = to;
                }
                Step::Cubic(first, second, to) => {
                    let to = transform.of(to);
                    chords(at, transform.of(first), transform.of(second), to, &mut line);
                    at = to;
                }
                Step::Close => {
                    line(at, start);
                    at = start;
                }
            }
        }
        line(at, start);
    }
}

fn between(a: Point, b: Point, t: f64) -> Point {
    (a.0 + (b.0 - a.0) * t, a.1 + (b.1 - a.1) * t)
}

/// The number of chords of equal parameter steps that keeps within the tolerance. The distance of a chord over a step h is
/// at most h^2 / 8 times the largest second derivative, which is at most 6 times the second differences.
fn chords(from: Point, first: Point, second: Point, to: Point, line: &mut impl FnMut(Point, Point)) {
    let bend = |a: Point, b: Point, c: Point| (a.0 - 2.0 * b.0 + c.0).hypot(a.1 - 2.0 * b.1 + c.1);
    let second_derivative = 6.0 * bend(from, first, second).max(bend(first, second, to));
    let count = (second_derivative / (8.0 * TOLERANCE)).sqrt().ceil().clamp(1.0, MOST_CHORDS);
    let mut at = from;
    for index in 1..=count as u32 {
        let t = f64::from(index) / count;
        // De Casteljau: exact at both ends.
        let (a, b, c) = (between(from, first, t), between(first, second, t), between(second, to, t));
        let next = between(between(a, b, t), between(b, c, t), t);
        line(at, next);
        at = next;
    }
}
