//! Builds one program for all hypotheses of a model solution: each line that the catalogue changes selects its
//! variant by a uniform.
//!
//! A software driver compiles a program in the time in which it draws a hundred small pictures, and there are a
//! hundred mistakes. So there is one program, and a hypothesis is a few integers.

use super::{Mistake, ModelSolution};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// A hypothesis about a program: changes to different lines of a model solution, mistakes or harmless peculiarities.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Hypothesis {
    /// For each changed line, by its index among the changeable ones: the variant, from 1.
    pub choices: BTreeMap<usize, usize>,
    /// Indices into [`Hypotheses::mistakes`].
    pub mistakes: Vec<usize>,
}

impl Hypothesis {
    /// Combines two hypotheses; `None` if they change the same line.
    pub fn and(&self, other: &Hypothesis) -> Option<Hypothesis> {
        if other.choices.keys().any(|line| self.choices.contains_key(line)) {
            return None;
        }
        let mut both = self.clone();
        both.choices.extend(&other.choices);
        both.mistakes.extend(&other.mistakes);
        Some(both)
    }
}

/// Programs that limit the cosine of the highlight, of diffuse light, or both to 1.
const LIMITED: [&[(&str, &str)]; 3] = [
    &[("cos_phi", "clamp(cos_highlight, 0.0, 1.0)")],
    &[("cos_theta", "clamp(dot(N, L), 0.0, 1.0)")],
    &[("cos_phi", "clamp(cos_highlight, 0.0, 1.0)"), ("cos_theta", "clamp(dot(N, L), 0.0, 1.0)")],
];

/// A model solution with all its hypotheses.
pub struct Hypotheses {
    /// The model solution.
    pub model: ModelSolution,
    /// The mistakes that can be made in it, harmless ones included.
    pub mistakes: Vec<&'static Mistake>,
    /// One hypothesis for each way to make each mistake.
    pub singles: Vec<Hypothesis>,
    /// The variables of the changeable lines; the uniform `way_NAME` selects the variant of each.
    pub variables: Vec<String>,
    sources: [String; 2],
    /// The value that each variable is assigned first.
    values: BTreeMap<String, String>,
    alternatives: Vec<Vec<String>>,
}

/// A line of a model solution that assigns a value: `    vec3 N = normalize(v);`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Assignment<'a> {
    /// The variable.
    pub variable: &'a str,
    /// Its type, if the line declares it.
    pub ty: Option<&'a str>,
    /// The value's text.
    pub value: &'a str,
    /// The offset of the value in the line.
    pub at: usize,
}

impl<'a> Assignment<'a> {
    /// `None` for any other line.
    pub fn of(line: &'a str) -> Option<Self> {
        let code = line.split("//").next()?.trim_end().strip_suffix(';')?;
        let at = code.find(" = ")?;
        let mut words = code[..at].split_whitespace().rev();
        let (variable, ty) = (words.next()?, words.next().filter(|ty| *ty != "const"));
        Some(Assignment { variable, ty, value: &code[at + 3..], at: at + 3 })
    }
}

fn identifiers(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

impl Hypotheses {
    /// Collects the hypotheses of a model solution. A mistake that names a variable which the model does not write is
    /// left out; a test ensures that there is none.
    pub fn for_model(model: ModelSolution) -> Self {
        let sources = model.sources();
        let mut values = BTreeMap::new();
        for Assignment { variable, value, .. } in
            sources.iter().flat_map(|source| source.lines()).filter_map(Assignment::of)
        {
            values.entry(variable.to_owned()).or_insert_with(|| value.to_owned());
        }
        let mut all = Hypotheses {
            model,
            mistakes: Vec::new(),
            singles: Vec::new(),
            variables: Vec::new(),
            sources: sources.map(str::to_owned),
            values,
            alternatives: Vec::new(),
        };
        for mistake in super::for_model(model) {
            let index = all.mistakes.len();
            all.mistakes.push(mistake);
            for change in &mistake.change {
                if !change.keys().all(|variable| all.values.contains_key(variable)) {
                    continue;
                }
                let choices = change.iter().map(|(variable, text)| all.choice(variable, text)).collect();
                let single = Hypothesis { choices, mistakes: vec![index] };
                let limits = if mistake.exceeds_one && model.is_lit() { &LIMITED[..] } else { &[] };
                let limited: Vec<Hypothesis> = limits.iter().map(|limit| all.limited(&single, limit)).collect();
                all.singles.push(single);
                all.singles.extend(limited);
            }
        }
        all
    }

    /// A mistake in a program that limits cosines.
    fn limited(&mut self, single: &Hypothesis, limits: &[(&str, &str)]) -> Hypothesis {
        let mut limited = single.clone();
        for (variable, text) in limits {
            let (line, way) = self.choice(variable, text);
            limited.choices.entry(line).or_insert(way);
        }
        limited
    }

    /// Returns the line and the variant of a change, and adds the variant if it is new.
    fn choice(&mut self, variable: &str, text: &str) -> (usize, usize) {
        let line = self.variables.iter().position(|known| known == variable).unwrap_or_else(|| {
            self.variables.push(variable.to_owned());
            self.alternatives.push(Vec::new());
            self.variables.len() - 1
        });
        let ways = &mut self.alternatives[line];
        let way = ways.iter().position(|known| known == text).unwrap_or_else(|| {
            ways.push(text.to_owned());
            ways.len() - 1
        });
        (line, way + 1)
    }

    /// Returns the uniform that selects the variant of a line.
    pub fn uniform(&self, line: usize) -> String {
        format!("way_{}", self.variables[line])
    }

    /// Returns the value that a hypothesis assigns to a variable; `None` if no line assigns one.
    pub fn text_of(&self, variable: &str, hypothesis: &Hypothesis) -> Option<&str> {
        let chosen = self.variables.iter().position(|known| known == variable).and_then(|line| {
            let way = hypothesis.choices.get(&line)?.checked_sub(1)?;
            self.alternatives.get(line)?.get(way).map(String::as_str)
        });
        chosen.or_else(|| self.values.get(variable).map(String::as_str))
    }

    /// Returns the variables in these names, and all that they are computed from.
    pub fn with_parts(&self, names: &BTreeSet<String>) -> BTreeSet<String> {
        let mut variables = BTreeSet::new();
        let mut open: Vec<String> = names.iter().flat_map(|name| identifiers(name)).map(str::to_owned).collect();
        while let Some(variable) = open.pop() {
            if let Some(text) = self.text_of(&variable, &Hypothesis::default())
                && variables.insert(variable.clone())
            {
                // Beside `P`, `V` is the view matrix and not the direction to the eye.
                let is_product = text.contains("P * V");
                open.extend(identifiers(text).filter(|part| !is_product || *part != "V").map(str::to_owned));
            }
        }
        variables
    }

    /// Returns a vertex and a fragment shader for all hypotheses, `#version 330 core`. With all uniforms `way_...` at
    /// 0 they are the model solution itself.
    pub fn sources(&self) -> [String; 2] {
        self.sources.each_ref().map(|source| {
            self.rewritten(
                source,
                |line, right, ways| {
                    let uniform = self.uniform(line);
                    let mut chosen = String::new();
                    for (way, text) in ways.iter().enumerate() {
                        // Writing into a String cannot fail.
                        let _ = write!(chosen, "{uniform} == {} ? ({text}) : ", way + 1);
                    }
                    format!("{chosen}({right})")
                },
                true,
            )
        })
    }

    /// Returns the model solution with one hypothesis applied, as a person would write it.
    pub fn written(&self, hypothesis: &Hypothesis) -> [String; 2] {
        self.sources.each_ref().map(|source| {
            self.rewritten(
                source,
                |line, right, ways| {
                    let way = hypothesis.choices.get(&line).copied().unwrap_or(0);
                    way.checked_sub(1).and_then(|way| ways.get(way)).map_or(right, |text| text).to_owned()
                },
                false,
            )
        })
    }

    fn rewritten(&self, source: &str, write: impl Fn(usize, &str, &[String]) -> String, declare: bool) -> String {
        let mut text = String::new();
        let mut used = Vec::new();
        for line in source.lines() {
            let known = Assignment::of(line)
                .and_then(|found| Some((self.variables.iter().position(|v| v == found.variable)?, found.value)));
            match known {
                Some((index, right)) => {
                    let before = &line[..line.find(" = ").map_or(0, |at| at + 3)];
                    text.push_str(&format!("{before}{};\n", write(index, right, &self.alternatives[index])));
                    used.push(index);
                }
                None => {
                    text.push_str(line);
                    text.push('\n');
                }
            }
        }
        if declare {
            let uniforms: String = used.iter().map(|&line| format!("uniform int {};\n", self.uniform(line))).collect();
            if let Some(end) = text.find('\n') {
                text.insert_str(end + 1, &uniforms);
            }
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn assignments_are_parsed() {
        let parts = |line| Assignment::of(line).map(|found| (found.ty, found.variable, found.value, found.at));
        let normal = (Some("vec3"), "N", "normalize(v_normal)", 13);
        assert_eq!(parts("    vec3 N = normalize(v_normal); // why"), Some(normal));
        assert_eq!(parts("gl_Position = P * V;"), Some((None, "gl_Position", "P * V", 14)));
        assert_eq!(parts("if (a == b) {"), None);
    }

    #[test]
    fn every_change_applies() {
        for model in ModelSolution::ALL {
            let hypotheses = Hypotheses::for_model(model);
            let limited = |mistake: &Mistake| if mistake.exceeds_one && model.is_lit() { 1 + LIMITED.len() } else { 1 };
            let ways: usize =
                super::super::for_model(model).map(|mistake| mistake.change.len() * limited(mistake)).sum();
            assert_eq!(hypotheses.singles.len(), ways, "{model:?}");
            assert!(ways > 3, "{model:?}");
        }
    }

    #[test]
    fn without_a_choice_the_program_is_the_model_solution() {
        for model in ModelSolution::ALL {
            let written = Hypotheses::for_model(model).written(&Hypothesis::default());
            for (written, source) in written.iter().zip(model.sources()) {
                let without_remarks = |text: &str| -> Vec<String> {
                    text.lines().map(|line| line.split(" //").next().unwrap_or_default().to_owned()).collect()
                };
                assert_eq!(without_remarks(written), without_remarks(source));
            }
        }
    }

    #[test]
    fn changes_of_one_line_exclude_each_other() {
        let hypotheses = Hypotheses::for_model(ModelSolution::Phong);
        let by_id = |id: &str| hypotheses.singles.iter().find(|h| hypotheses.mistakes[h.mistakes[0]].id == id).unwrap();
        assert!(by_id("diffuse-absolute").and(by_id("diffuse-not-clamped")).is_none());
        let both = by_id("diffuse-absolute").and(by_id("normal-by-model-matrix")).unwrap();
        let [vertex, fragment] = hypotheses.written(&both);
        assert!(vertex.contains("vec3 world_normal = mat3(M) * normal;"), "{vertex}");
        assert!(fragment.contains("float cos_theta = abs(dot(N, L));"), "{fragment}");
    }
}
