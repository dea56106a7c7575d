//! A command as Markdown: description, arguments, options, examples.

use super::{anchor, escaped, paragraphs};
use clap::{Arg, Command};
use std::collections::BTreeMap;

/// An option that so many commands have, with the same text, is described once.
const SHARED_BY: usize = 3;

/// Options that several commands have, described once.
pub struct SharedOptions {
    /// Headings in the order in which commands list them, each with the descriptions of its options.
    groups: Vec<(String, Vec<String>)>,
}

impl SharedOptions {
    /// The shared options of all commands below `command`.
    pub fn of(command: &Command) -> SharedOptions {
        let mut counted: BTreeMap<(String, String), usize> = BTreeMap::new();
        let mut order = Vec::new();
        for_each_command(command, &mut |inner| {
            for (heading, description) in options_of(inner) {
                let key = (heading, description);
                order.push(key.clone());
                *counted.entry(key).or_default() += 1;
            }
        });
        let mut groups: Vec<(String, Vec<String>)> = Vec::new();
        for (heading, description) in order {
            if counted.remove(&(heading.clone(), description.clone())).is_none_or(|count| count < SHARED_BY) {
                continue;
            }
            match groups.iter_mut().find(|(known, _)| *known == heading) {
                Some((_, descriptions)) => descriptions.push(description),
                None => groups.push((heading, vec![description])),
            }
        }
        SharedOptions { groups }
    }

    /// The page that describes them.
    pub fn page(&self) -> String {
        let mut page = String::from(
            "# Options of several commands\n\nEach command lists which of them it has, and describes the others.\n",
        );
        for (heading, descriptions) in &self.groups {
            page += &format!("\n## {heading}\n\n{}", descriptions.concat());
        }
        page
    }

    fn contains(&self, heading: &str, description: &str) -> bool {
        self.groups.iter().any(|(known, all)| known == heading && all.iter().any(|one| one == description))
    }
}

/// Calls `visit` with every command below `command` that is listed.
fn for_each_command(command: &Command, visit: &mut dyn FnMut(&Command)) {
    for inner in command.get_subcommands().filter(|inner| !inner.is_hide_set() && inner.get_name() != "help") {
        visit(inner);
        for_each_command(inner, visit);
    }
}

/// The options of a command, each with its heading and its description.
fn options_of(command: &Command) -> Vec<(String, String)> {
    let listed = command.get_arguments().filter(|arg| !arg.is_positional() && !arg.is_hide_set());
    listed.map(|arg| (arg.get_help_heading().unwrap_or("Options").to_owned(), described(arg))).collect()
}

/// An argument as an item of a list.
fn described(arg: &Arg) -> String {
    let short = arg.get_short().map_or(String::new(), |short| format!("`-{short}`, "));
    let mut item = format!("- {short}`{arg}`: ");
    let help = arg.get_long_help().or(arg.get_help()).map(ToString::to_string).unwrap_or_default();
    item += &escaped(&help.split("\n\n").map(str::trim).collect::<Vec<_>>().join(" ").replace('\n', " "));
    if !item.ends_with(['.', ':']) {
        item.push('.');
    }
    let values: Vec<_> = arg.get_possible_values().into_iter().filter(|value| !value.is_hide_set()).collect();
    if arg.get_action().takes_values() && !values.is_empty() {
        let names: Vec<String> = values.iter().map(|value| format!("`{}`", value.get_name())).collect();
        item += &format!(" One of {}.", names.join(", "));
    }
    let defaults: Vec<_> = arg.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
    if arg.get_action().takes_values() && !defaults.is_empty() {
        item += &format!(" Default: `{}`.", defaults.join(" "));
    }
    if let Some(aliases) = arg.get_visible_aliases().filter(|aliases| !aliases.is_empty()) {
        let names: Vec<String> = aliases.iter().map(|name| format!("`--{name}`")).collect();
        item += &format!(" Also {}.", names.join(", "));
    }
    item.push('\n');
    item
}

/// The section of a command and those of the commands below it. `path` is what one types.
pub fn describe(command: &Command, path: &str, shared: &SharedOptions) -> String {
    let about = command.get_long_about().or(command.get_about()).map(ToString::to_string).unwrap_or_default();
    let usage = command.clone().render_usage().to_string();
    let usage = usage.trim_start_matches("Usage: ");
    let mut section = format!("\n## {path}\n\n{}\n```text\n{usage}\n```\n", paragraphs(&about));
    let arguments: Vec<String> =
        command.get_arguments().filter(|arg| arg.is_positional() && !arg.is_hide_set()).map(described).collect();
    if !arguments.is_empty() {
        section += &format!("\n**Arguments**\n\n{}", arguments.concat());
    }
    let mut own: Vec<(String, Vec<String>)> = Vec::new();
    let mut elsewhere: Vec<String> = Vec::new();
    for (heading, description) in options_of(command) {
        if shared.contains(&heading, &description) {
            let link = format!("[{heading}](options.md#{})", anchor(&heading));
            if !elsewhere.contains(&link) {
                elsewhere.push(link);
            }
        } else {
            match own.iter_mut().find(|(known, _)| *known == heading) {
                Some((_, all)) => all.push(description),
                None => own.push((heading, vec![description])),
            }
        }
    }
    for (heading, descriptions) in own {
        section += &format!("\n**{heading}**\n\n{}", descriptions.concat());
    }
    let names: Vec<String> = shared_names(command, shared).iter().map(|name| format!("`{name}`")).collect();
    // Every command has --help: that alone is not worth a line.
    if names.len() > 1 {
        section += &format!("\n**Also** ({}): {}\n", elsewhere.join(", "), names.join(", "));
    }
    if let Some(after) = command.get_after_long_help() {
        section += &after_help(&after.to_string());
    }
    for inner in command.get_subcommands().filter(|inner| !inner.is_hide_set() && inner.get_name() != "help") {
        section += &describe(inner, &format!("{path} {}", inner.get_name()), shared);
    }
    section
}

/// The names of a command's options that are described elsewhere.
fn shared_names(command: &Command, shared: &SharedOptions) -> Vec<String> {
    let options = command.get_arguments().filter(|arg| !arg.is_positional() && !arg.is_hide_set());
    let is_shared = |arg: &&Arg| shared.contains(arg.get_help_heading().unwrap_or("Options"), &described(arg));
    options.filter(is_shared).filter_map(|arg| arg.get_long().map(|long| format!("--{long}"))).collect()
}

/// The text after the options: examples as a block of commands, with what they do as comments, then the rest.
fn after_help(text: &str) -> String {
    let mut lines = text.lines().peekable();
    let mut examples = String::new();
    let mut rest = String::new();
    let mut inside = false;
    while let Some(line) = lines.next() {
        if line == "Examples:" {
            inside = true;
        } else if inside && line.starts_with("      ") {
            examples += &format!("# {}\n", line.trim());
        } else if inside && line.starts_with("  ") {
            // A command comes after what it does, in a block as in a program.
            let mut comments = String::new();
            while let Some(next) = lines.next_if(|next| next.starts_with("      ")) {
                comments += &format!("# {}\n", next.trim());
            }
            examples += &format!("{comments}{}\n", line.trim());
        } else if line.is_empty() {
            rest.push('\n');
        } else {
            inside = false;
            rest += &format!("{}\n", escaped(line.trim()));
        }
    }
    let mut section = String::new();
    if !examples.is_empty() {
        section += &format!("\n```sh,parse\n{examples}```\n");
    }
    let rest = rest.trim();
    if !rest.is_empty() {
        section += &format!("\n{rest}\n");
    }
    section
}
