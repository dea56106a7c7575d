//! GLSL expressions as text with a precedence, the marks that show in the text where a quantity is computed, and the random
//! numbers that choose between ways to write it.

/// A quantity that a program computes, and where a mistake can be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Site {
    /// The normal after its transformation.
    NormalTransform,
    /// The position that the light is computed from.
    Position,
    /// `gl_Position`.
    ClipPosition,
    /// The unit normal that the light is computed with.
    Normal,
    /// The direction to the light.
    LightDirection,
    /// The direction to the eye, or from it.
    ViewDirection,
    /// The reflected direction or the half vector.
    Mirror,
    /// The cosine of the diffuse term.
    DiffuseCosine,
    /// The base of the power.
    SpecularCosine,
    /// The power.
    Power,
    /// The distance to the light.
    Distance,
    /// The attenuation.
    Attenuation,
    /// The ambient term.
    Ambient,
    /// The diffuse term.
    Diffuse,
    /// The specular term.
    Specular,
    /// The sum of the terms.
    Sum,
    /// The sum over lights.
    Lights,
    /// The colour that is output.
    Output,
    /// The ratio of refractive indices.
    Ratio,
    /// The direction in which the cubemap is sampled.
    Lookup,
    /// The view matrix of a skybox.
    Turn,
    /// The direction of a corner of a skybox.
    Direction,
}

impl Site {
    const FIRST: u32 = 0xE000;

    fn mark(self, end: bool) -> char {
        char::from_u32(Self::FIRST + 2 * self as u32 + u32::from(end)).unwrap_or(' ')
    }

    const ALL: [Site; 22] = [
        Site::NormalTransform,
        Site::Position,
        Site::ClipPosition,
        Site::Normal,
        Site::LightDirection,
        Site::ViewDirection,
        Site::Mirror,
        Site::DiffuseCosine,
        Site::SpecularCosine,
        Site::Power,
        Site::Distance,
        Site::Attenuation,
        Site::Ambient,
        Site::Diffuse,
        Site::Specular,
        Site::Sum,
        Site::Lights,
        Site::Output,
        Site::Ratio,
        Site::Lookup,
        Site::Turn,
        Site::Direction,
    ];
}

/// Whether a character is a mark.
fn is_mark(c: char) -> bool {
    (Site::FIRST..Site::FIRST + 0x100).contains(&(c as u32))
}

/// The text without its marks.
pub(crate) fn plain(text: &str) -> String {
    text.chars().filter(|c| !is_mark(*c)).collect()
}

/// Removes the marks of a text; returns the lines of each site, from 1.
pub(crate) fn take_marks(text: &str) -> (String, Vec<(Site, u32)>) {
    let (mut line, mut found, mut open) = (1, Vec::new(), Vec::new());
    for c in text.chars() {
        if c == '\n' {
            line += 1;
            found.extend(open.iter().map(|site| (*site, line)));
        } else if is_mark(c) {
            let number = c as u32 - Site::FIRST;
            let Some(site) = Site::ALL.get(number as usize / 2) else { continue };
            if number.is_multiple_of(2) {
                open.push(*site);
                found.push((*site, line));
            } else if let Some(at) = open.iter().rposition(|other| other == site) {
                open.remove(at);
            }
        }
    }
    found.sort_unstable();
    found.dedup();
    (plain(text), found)
}

/// An expression and how tightly it binds.
#[derive(Clone, Debug)]
pub(crate) struct Expr {
    pub text: String,
    rank: u8,
}

const ATOM: u8 = 5;
const UNARY: u8 = 4;
const PRODUCT: u8 = 3;
const SUM: u8 = 2;
const OTHER: u8 = 0;

impl Expr {
    /// A name, a number or a call.
    pub fn atom(text: impl Into<String>) -> Self {
        Expr { text: text.into(), rank: ATOM }
    }

    pub fn call(name: &str, arguments: &[&Expr]) -> Self {
        let list: Vec<&str> = arguments.iter().map(|argument| argument.text.as_str()).collect();
        Expr::atom(format!("{name}({})", list.join(", ")))
    }

    fn at_least(&self, rank: u8) -> String {
        if self.rank >= rank { self.text.clone() } else { format!("({})", self.text) }
    }

    pub fn add(&self, other: &Expr) -> Expr {
        Expr { text: format!("{} + {}", self.at_least(SUM), other.at_least(SUM)), rank: SUM }
    }

    pub fn sub(&self, other: &Expr) -> Expr {
        Expr { text: format!("{} - {}", self.at_least(SUM), other.at_least(PRODUCT)), rank: SUM }
    }

    pub fn mul(&self, other: &Expr) -> Expr {
        Expr { text: format!("{} * {}", self.at_least(PRODUCT), other.at_least(UNARY)), rank: PRODUCT }
    }

    pub fn div(&self, other: &Expr) -> Expr {
        Expr { text: format!("{} / {}", self.at_least(PRODUCT), other.at_least(UNARY)), rank: PRODUCT }
    }

    pub fn neg(&self) -> Expr {
        // Two minus signs would be a decrement.
        let operand = if plain(&self.text).starts_with('-') { format!("({})", self.text) } else { self.at_least(ATOM) };
        Expr { text: format!("-{operand}"), rank: UNARY }
    }

    pub fn field(&self, name: &str) -> Expr {
        Expr { text: format!("{}.{name}", self.at_least(ATOM)), rank: ATOM }
    }

    pub fn choose(condition: &str, yes: &Expr, no: &Expr) -> Expr {
        Expr { text: format!("{condition} ? {} : {}", yes.at_least(SUM), no.at_least(SUM)), rank: OTHER }
    }

    /// Marks where a quantity is computed.
    pub fn at(self, site: Site) -> Expr {
        Expr { text: format!("{}{}{}", site.mark(false), self.text, site.mark(true)), rank: self.rank }
    }
}

/// SplitMix64 (G. Steele, D. Lea and C. Flood, *Fast Splittable Pseudorandom Number Generators*, 2014).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(seed)
    }

    /// A generator of its own for something with a name and a number.
    pub fn named(self, name: &str, number: u64) -> Self {
        // FNV-1a.
        let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        });
        let mut random = Random(self.0 ^ hash ^ number.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        Random(random.next())
    }

    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `count`; 0 if that is 0.
    pub fn below(&mut self, count: usize) -> usize {
        (self.next() % (count.max(1) as u64)) as usize
    }

    /// True with this probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64 >= 1.0 - probability
    }

    /// One of several.
    pub fn pick<T: Copy>(&mut self, all: &[T]) -> Option<T> {
        all.get(self.below(all.len())).copied()
    }

    /// One of several with a weight each; the first if all weights are 0.
    pub fn weighted<T: Copy>(&mut self, all: &[(u32, T)], otherwise: T) -> T {
        let mut left = self.below(all.iter().map(|(weight, _)| *weight as usize).sum());
        for (weight, one) in all {
            if left < *weight as usize {
                return *one;
            }
            left -= *weight as usize;
        }
        otherwise
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_keep_their_meaning_in_text() {
        let [a, b, c] = ["a", "b", "c"].map(Expr::atom);
        assert_eq!(a.sub(&b.sub(&c)).text, "a - (b - c)");
        assert_eq!(a.add(&b).mul(&c.neg()).text, "(a + b) * -c");
        assert_eq!(a.neg().neg().text, "-(-a)");
        assert_eq!(a.div(&b.mul(&c)).text, "a / (b * c)");
        assert_eq!(a.sub(&b).field("xyz").text, "(a - b).xyz");
        assert_eq!(a.neg().field("x").text, "(-a).x");
    }

    #[test]
    fn marks_give_the_lines_of_a_quantity() {
        let n = Expr::atom("n").at(Site::Normal);
        let l = Expr::atom("f(\n  x)").at(Site::LightDirection);
        let (text, lines) = take_marks(&format!("\n{};\n{};\n", n.text, l.text));
        assert_eq!(text, "\nn;\nf(\n  x);\n");
        assert_eq!(lines, [(Site::Normal, 2), (Site::LightDirection, 3), (Site::LightDirection, 4)]);
    }

    #[test]
    fn the_list_of_sites_is_in_order() {
        assert!(Site::ALL.iter().enumerate().all(|(index, site)| *site as usize == index));
    }
}
