//! Vectors that hold several inputs: `vec4(eye.xyz, shininess)`, or three strengths in one `vec3`.

use super::{Bindings, Bound, Declared, Role, VariableKind};

/// How a pair of shaders reads a uniform vector.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct VectorReads {
    /// Whether its last of four components is only read alone, and the others only without it.
    pub last_is_apart: bool,
    /// Whether one of the first three components is read alone, or all three are an operand of `dot`.
    pub is_packed: bool,
    /// Whether several components are read together.
    pub is_vector: bool,
    /// Whether the second and the third are multiplied by the same variable, or all stand under a division.
    pub is_polynomial: bool,
}

impl VectorReads {
    /// Reads the tokens of a pair, without comments. `name` is a variable or a member: `lamp.data`.
    #[must_use]
    pub fn new<'t>(tokens: &[&'t str], name: &'t str) -> Self {
        // A struct may be passed to a function, which has another name for it.
        let path: Vec<&str> = match name.rsplit_once('.') {
            Some((_, member)) => vec![".", member],
            None => vec![name],
        };
        let mut reads = VectorReads::default();
        let (mut apart, mut whole) = (false, false);
        let mut factors: [Vec<&str>; 2] = Default::default();
        let mut is_divisor = false;
        for at in (0..tokens.len()).filter(|at| tokens[*at..].starts_with(&path)) {
            if path.len() == 1 && (at > 0 && tokens[at - 1] == "." || is_declaration(tokens, at)) {
                continue;
            }
            let end = at + path.len();
            let components = match tokens.get(end..end + 2) {
                Some([".", components]) => *components,
                _ => "xyzw",
            };
            reads.is_vector |= components.len() > 1;
            let is_last = |c: char| matches!(c, 'w' | 'a' | 'q');
            match (components.len(), components.contains(is_last)) {
                (1, true) => apart = true,
                // `r`, `g` and `b` are those of a colour.
                (1, false) => reads.is_packed |= "xyzstp".contains(components),
                (_, true) => whole = true,
                (_, false) => {}
            }
            let start = begin_of(tokens, at + path.len() - 1);
            if let Some(factors) = ["y", "z"].iter().position(|of| *of == components).map(|of| &mut factors[of]) {
                let of_product = |operator: Option<&&'t str>, operand: Option<&&'t str>| {
                    operand.copied().filter(|_| operator == Some(&"*"))
                };
                factors.extend(of_product(tokens.get(end + 2), tokens.get(end + 3)));
                // Not a divisor.
                let before = &tokens[..start];
                let is_factor = before.iter().nth_back(2) != Some(&"/");
                factors.extend(of_product(before.last(), before.iter().nth_back(1)).filter(|_| is_factor));
                is_divisor |= is_under_division(tokens, start);
            }
            reads.is_packed |= at > 1 && tokens[at - 2] == "dot" && tokens[at - 1] == "(";
        }
        reads.last_is_apart = apart && !whole;
        reads.is_polynomial = is_divisor || factors[0].iter().any(|factor| factors[1].contains(factor));
        reads
    }
}

/// The first token of the variable whose last name is at a place: `lamps[i].data`.
fn begin_of(tokens: &[&str], mut at: usize) -> usize {
    while at > 1 && tokens[at - 1] == "." {
        at -= 2;
        if tokens[at] == "]" {
            let open = tokens[..at].iter().rposition(|token| *token == "[");
            at = open.map_or(0, |open| open.saturating_sub(1));
        }
    }
    at
}

/// Whether a place is within parentheses that something is divided by.
fn is_under_division(tokens: &[&str], at: usize) -> bool {
    let mut open = 0;
    for before in (1..at).rev() {
        match tokens[before] {
            ";" | "{" | "}" => return false,
            ")" => open += 1,
            "(" if open > 0 => open -= 1,
            "(" if tokens[before - 1] == "/" => return true,
            _ => {}
        }
    }
    false
}

/// Whether a name is declared here.
fn is_declaration(tokens: &[&str], at: usize) -> bool {
    let start = tokens[..at].iter().rposition(|token| matches!(*token, ";" | "{" | "}")).map_or(0, |before| before + 1);
    let statement = &tokens[start..at];
    statement.contains(&"uniform")
        || statement.iter().any(|token| matches!(*token, "vec2" | "vec3" | "vec4"))
            && !statement.contains(&"=")
            && !statement.contains(&"(")
}

/// The last component of a vector of four, as a variable of its own.
pub(crate) fn last_of(vector: &Declared) -> Declared {
    Declared::uniform(format!("{}{LAST}", vector.name), "float")
}

const LAST: &str = ".w";

impl Bindings {
    /// The input that the last component of a vector holds, if it holds one.
    #[must_use]
    pub fn last_of(&self, vector: &Declared) -> Option<&Bound> {
        if vector.glsl_type != "vec4" || vector.kind != VariableKind::Uniform {
            return None;
        }
        let is_last = |bound: &&Bound| bound.declared.name.strip_suffix(LAST) == Some(&vector.name);
        self.bound.iter().find(is_last)
    }

    /// Whether it is the last component of a vector, and 1, as in a position.
    #[must_use]
    pub fn is_usual_last(&self, bound: &Bound) -> bool {
        let vector = bound.declared.name.strip_suffix(LAST).filter(|_| bound.role == Role::Tint);
        let all = self.bound.iter().map(|bound| &bound.declared).chain(&self.unknown);
        vector.is_some_and(|vector| {
            all.into_iter().any(|declared| declared.name == vector && declared.glsl_type == "vec4")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::VectorReads;

    #[test]
    fn the_last_component_may_be_an_input_of_its_own() {
        for (text, name, last_is_apart, is_packed) in [
            ("uniform vec4 eye ; f ( eye . xyz , eye . w ) ;", "eye", true, false),
            ("uniform vec4 eye ; f ( eye ) ; g ( eye . w ) ;", "eye", false, false),
            ("uniform vec4 eye ; f ( eye . xyz ) ;", "eye", false, false),
            ("uniform vec4 a , eye ; f ( eye . a ) ;", "eye", true, false),
            ("struct L { vec4 eye ; } ; f ( l . eye . w , l . eye . rgb ) ;", "l.eye", true, false),
            ("struct L { vec4 eye ; } ; f ( p . eye . w ) ;", "l[0].eye", true, false),
            ("uniform vec3 k ; float a = k . x + k . y ;", "k", false, true),
            ("uniform vec3 k ; float a = dot ( k , t ) ;", "k", false, true),
            ("uniform vec3 k ; vec3 a = k * t ;", "k", false, false),
            ("uniform vec3 k ; float a = k . x ; b ( k )", "k", false, true),
            ("uniform vec3 k ; float a = k . r + k . g ;", "k", false, false),
        ] {
            let tokens: Vec<&str> = text.split(' ').collect();
            let reads = VectorReads::new(&tokens, name);
            assert_eq!((reads.last_is_apart, reads.is_packed), (last_is_apart, is_packed), "{text}");
        }
    }

    #[test]
    fn coefficients_of_a_polynomial_are_told_from_strengths() {
        for (text, name, expected) in [
            ("u = k . x + k . y * d + k . z * d * d ;", "k", true),
            ("u = k . x + d * k . y + k . z * d * d ;", "k", true),
            ("u = p . k . x + d * p . k . y + d * d * p . k . z ;", "q[0].k", true),
            ("u = d * a [ i ] . k . y + d * a [ 0 ] . k . z ;", "a[0].k", true),
            ("u = 1.0 / ( k . x + e * ( k . y + d * k . z ) ) ;", "k", true),
            ("u = k . x + a * ( k . y * diffuse + k . z * specular ) ;", "k", false),
            ("u = k . x ; u += a / d * k . y ; u += b / d * k . z ;", "k", false),
        ] {
            let tokens: Vec<&str> = text.split(' ').collect();
            assert_eq!(VectorReads::new(&tokens, name).is_polynomial, expected, "{text}");
        }
    }
}
