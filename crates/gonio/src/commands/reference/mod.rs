//! The reference of gonio's book as Markdown, made from the program itself: `gonio man --markdown DIR`.
//!
//! | file | contents |
//! |---|---|
//! | `options` | a command's description, arguments, options and examples |
//! | `lists` | exercises, mistakes, BRDF models, environments and stations |

mod lists;
mod options;

use clap::Command;
use options::SharedOptions;

/// A page of the reference: the name of its file and its text.
pub type ReferencePage = (String, String);

/// A group of commands by its heading, and the list that it ends with.
type GroupList = (&'static str, fn() -> String);

/// The groups of commands that end with a list of what they work on.
const LISTS: &[GroupList] = &[
    ("Pictures", lists::stations),
    ("Environments", lists::environments),
    ("Materials", lists::brdf_models),
    ("Exercises", lists::exercises),
];

/// Every page of the reference. `command` is the whole command line.
pub fn pages(mut command: Command) -> Vec<ReferencePage> {
    command.build();
    let groups = groups(&command);
    let shared = SharedOptions::of(&command);
    let mut index = String::from(
        "# Reference\n\nThe program writes these pages itself (`gonio man --markdown`), from what it parses and what it knows. \
         `gonio help COMMAND` prints the same about a command.\n",
    );
    let mut pages = Vec::new();
    for (heading, names) in &groups {
        let file = format!("{}.md", anchor(heading));
        let mut page = format!("# {heading}\n");
        index += &format!("\n## {heading}\n\n");
        // clap's own command `help` repeats the others.
        let inner = names.iter().filter(|name| *name != "help").filter_map(|name| command.find_subcommand(name));
        for inner in inner {
            let path = format!("gonio {}", inner.get_name());
            page += &options::describe(inner, &path, &shared);
            let about = inner.get_about().map(ToString::to_string).unwrap_or_default();
            index += &format!("- [`{path}`]({file}#{}): {}\n", anchor(&path), escaped(&about));
        }
        for (_, list) in LISTS.iter().filter(|(group, _)| group == heading) {
            page += &list();
        }
        pages.push((file, page));
    }
    index += "\n## Common to all commands\n\n\
        - [Options of several commands](options.md)\n\
        - [The catalogue of mistakes](mistakes.md)\n\
        - Exit codes: 0 success, 1 a check failed, 2 error. A closed pipe, as in `gonio inspect model.obj | head`, is a success.\n";
    pages.push(("options.md".to_owned(), shared.page()));
    pages.push(("mistakes.md".to_owned(), lists::mistakes()));
    pages.insert(0, ("README.md".to_owned(), index));
    pages
}

/// The groups of the overview, which is the text after a summary of the help, each with the names of its commands.
fn groups(command: &Command) -> Vec<(String, Vec<String>)> {
    let overview = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    let mut groups: Vec<(String, Vec<String>)> = Vec::new();
    for line in overview.lines() {
        if let Some(entry) = line.strip_prefix("  ") {
            let name = entry.split_whitespace().next().unwrap_or_default();
            if let Some((_, names)) = groups.last_mut() {
                names.push(name.to_owned());
            }
        } else if let Some(heading) = line.strip_suffix(':') {
            groups.push((heading.to_owned(), Vec::new()));
        }
    }
    groups
}

/// The anchor that mdBook gives to a heading.
fn anchor(heading: &str) -> String {
    let known = |c: char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
    heading.chars().filter(|&c| known(c)).collect::<String>().to_lowercase().replace(' ', "-")
}

/// Plain text as Markdown: outside of backticks, characters that Markdown reads are escaped.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    let mut is_code = false;
    for c in text.chars() {
        if c == '`' {
            is_code = !is_code;
        } else if !is_code && matches!(c, '<' | '>' | '*' | '_' | '[' | ']' | '\\' | '|' | '#' | '~') {
            escaped.push('\\');
        }
        escaped.push(c);
    }
    escaped
}

/// Lines of text as a paragraph, or several.
fn paragraphs(text: &str) -> String {
    let lines = text.trim().lines().map(|line| escaped(line.trim()));
    let mut paragraphs = String::new();
    for line in lines {
        paragraphs += &line;
        paragraphs.push('\n');
    }
    paragraphs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_stays_what_it_is() {
        assert_eq!(escaped("Keep <N.L> of sky_*.png, `a_b`"), "Keep \\<N.L\\> of sky\\_\\*.png, `a_b`");
        assert_eq!(anchor("gonio lab check"), "gonio-lab-check");
        assert_eq!(anchor("About gonio"), "about-gonio");
    }
}
