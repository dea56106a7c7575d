//! Rules about the workflows in `.github/`: each action is pinned to a commit, and each job has the permissions that it needs and no more.

use super::source::TextFile;

/// Complaints about workflows.
pub fn check(files: &[TextFile]) -> Vec<String> {
    let workflows: Vec<&TextFile> = files.iter().filter(|file| file.path.starts_with(".github/workflows/")).collect();
    if workflows.is_empty() {
        return vec!["there are no workflows in .github/workflows".into()];
    }
    workflows.into_iter().flat_map(check_workflow).collect()
}

fn check_workflow(file: &TextFile) -> Vec<String> {
    let lines: Vec<&str> = file.text.lines().collect();
    let mut complaints = Vec::new();
    if !lines.contains(&"permissions: {}") {
        complaints.push(format!("{}: takes permissions for all jobs; write `permissions: {{}}` at the top", file.path));
    }
    let jobs = lines.iter().position(|line| *line == "jobs:").unwrap_or(lines.len());
    for (index, line) in lines.iter().enumerate() {
        let mut complain = |what: &str| complaints.push(format!("{}:{}: {what}", file.path, index + 1));
        let is_job = index > jobs && line.starts_with("  ") && !line.starts_with("   ") && line.ends_with(':');
        if is_job {
            let body: Vec<&&str> =
                lines[index + 1..].iter().take_while(|l| l.is_empty() || l.starts_with("   ")).collect();
            if !body.iter().any(|l| **l == "    permissions:") {
                complain("the job states no permissions");
            }
            if !body.iter().any(|l| l.starts_with("    timeout-minutes: ")) {
                complain("the job has no timeout");
            }
        }
        if let Some(action) = line.trim_start().trim_start_matches("- ").strip_prefix("uses: ") {
            let (name, comment) = action.split_once(" # ").unwrap_or((action, ""));
            let commit = name.rsplit_once('@').map_or("", |(_, commit)| commit);
            if commit.len() != 40 || !commit.bytes().all(|byte| byte.is_ascii_hexdigit()) || !comment.starts_with('v') {
                complain("the action is not pinned to a commit, with its version as a comment");
            }
            if name.starts_with("actions/checkout@") {
                let options = lines[index + 1..].iter().take(2);
                if !options.into_iter().any(|l| l.trim() == "persist-credentials: false") {
                    complain("the checkout leaves credentials for later steps");
                }
            }
        }
    }
    complaints
}

#[cfg(test)]
mod tests {
    use super::*;

    fn complaints(text: &str) -> Vec<String> {
        check(&[TextFile { path: ".github/workflows/a.yml".into(), text: text.into() }])
    }

    const GOOD: &str = "\
on: push
permissions: {}
jobs:
  one:
    runs-on: x
    timeout-minutes: 5
    permissions:
      contents: read
    steps:
      - uses: actions/checkout@0123456789abcdef0123456789abcdef01234567 # v1.2.3
        with:
          persist-credentials: false
";

    #[test]
    fn a_pinned_workflow_passes() {
        assert!(complaints(GOOD).is_empty(), "{:?}", complaints(GOOD));
    }

    #[test]
    fn each_rule_is_checked() {
        for (good, bad, complaint) in [
            ("permissions: {}\n", "", "takes permissions for all jobs"),
            ("    permissions:\n      contents: read\n", "", "a.yml:4: the job states no permissions"),
            ("    timeout-minutes: 5\n", "", "a.yml:4: the job has no timeout"),
            ("@0123456789abcdef0123456789abcdef01234567 # v1.2.3", "@v1", "not pinned"),
            ("@0123456789abcdef0123456789abcdef01234567", "@0123456", "not pinned"),
            (" # v1.2.3", "", "not pinned"),
            ("persist-credentials: false", "fetch-depth: 0", "leaves credentials"),
        ] {
            let found = complaints(&GOOD.replace(good, bad));
            assert!(found.len() == 1 && found[0].contains(complaint), "{bad}: {found:?}");
        }
        assert_eq!(check(&[]).len(), 1);
    }
}
