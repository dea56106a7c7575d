//! The texts in `exercise.toml`: title, summary, details to look for and inputs, and their translations.

use gonio_exercises::exercise::{InputVariable, Inputs, LookFor, Texts};
use gonio_language::Language;
use gonio_scene::toml_table::{Fault, TableReader};
use std::collections::BTreeMap;

/// Reads the texts of the first language, which are at the top of the file.
pub(super) fn read_first(t: &mut TableReader<'_>) -> Result<Texts, Fault> {
    let title = t.text("title")?.ok_or_else(|| Fault::at(&(0..0), "the exercise has no title: add title = \"...\""))?;
    let summary = t.text("summary")?.unwrap_or_default();
    let mut look_for = Vec::new();
    for mut detail in t.tables("look_for")? {
        let text = detail.text("text")?.ok_or_else(|| Fault::at(&detail.span, "[[look_for]] has no `text`"))?;
        detail.finish()?;
        look_for.push(LookFor { text });
    }
    let mut inputs = Inputs::default();
    if let Some(mut table) = t.table("inputs", "[inputs]")? {
        inputs.attributes = read_variables(&mut table, "attributes", "[inputs.attributes]")?;
        inputs.uniforms = read_variables(&mut table, "uniforms", "[inputs.uniforms]")?;
        table.finish()?;
    }
    Ok(Texts { title, summary, look_for, inputs })
}

fn read_variables(
    t: &mut TableReader<'_>,
    key: &'static str,
    heading: &str,
) -> Result<BTreeMap<String, InputVariable>, Fault> {
    let mut variables = BTreeMap::new();
    for (name, mut table) in t.tables_by_name(key, heading)? {
        let mut text = |key: &'static str| {
            let found = table.text(key)?;
            found.ok_or_else(|| Fault::at(&table.span, format!("the input `{name}` has no `{key}`")))
        };
        let variable = InputVariable { glsl_type: text("type")?, meaning: text("meaning")?, value: text("value")? };
        table.finish()?;
        variables.insert(name, variable);
    }
    Ok(variables)
}

/// Reads the table of another language: `[fr]`. Inputs that it does not translate are those of the first language.
pub(super) fn read_translation(
    t: &mut TableReader<'_>,
    language: Language,
    first: &Texts,
) -> Result<Option<Texts>, Fault> {
    let code: &'static str = language.code();
    let Some(mut table) = t.table(code, &format!("[{code}]"))? else { return Ok(None) };
    let title = table.text("title")?.ok_or_else(|| Fault::at(&table.span, format!("[{code}] has no `title`")))?;
    let summary = table.text("summary")?.unwrap_or_default();
    let details = table.texts("look_for")?.unwrap_or_default();
    if details.len() != first.look_for.len() {
        let message = format!(
            "[{code}] has {} texts in `look_for`, and the first language has {}",
            details.len(),
            first.look_for.len()
        );
        return Err(Fault::at(&table.place("look_for"), message));
    }
    let mut inputs = first.inputs.clone();
    for (name, mut translated) in table.tables_by_name("inputs", &format!("[{code}.inputs]"))? {
        let (meaning, value) = (translated.text("meaning")?, translated.text("value")?);
        translated.finish()?;
        let known = inputs.attributes.get_mut(&name).or_else(|| inputs.uniforms.get_mut(&name));
        let Some(variable) = known else {
            return Err(Fault::at(&translated.span, format!("[{code}.inputs]: there is no input `{name}`")));
        };
        variable.meaning = meaning.unwrap_or_else(|| variable.meaning.clone());
        variable.value = value.unwrap_or_else(|| variable.value.clone());
    }
    table.finish()?;
    let look_for = details.into_iter().map(|text| LookFor { text }).collect();
    Ok(Some(Texts { title, summary, look_for, inputs }))
}
