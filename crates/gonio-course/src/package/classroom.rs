//! GitHub Classroom: a template repository whose workflow checks every push, and reports points to Classroom through its own
//! autograding reporter. Students can read all of it, so it has no reference, and they can change it: the README says what follows.

use super::gradescope::DRIVER_PACKAGES;
use super::{Package, PackageRequest, PackagedFile, shell_quoted};

pub(super) fn package(request: &PackageRequest<'_>) -> Package {
    let mut upload = request.start_in("");
    upload.push(PackagedFile::text(".github/workflows/classroom.yml", workflow(request)));
    upload.push(PackagedFile::script(".gonio/grade.sh", grade(request)));
    upload.extend(request.course_in(".gonio/course"));
    let is_there = upload.iter().any(|file| file.path == "README.md");
    if !is_there {
        upload.push(PackagedFile::text("README.md", students_readme(request)));
    }
    Package { upload, students: Vec::new(), readme: readme(request) }
}

fn workflow(request: &PackageRequest<'_>) -> String {
    let url = serde_json::to_string(&request.program_url).unwrap_or_default();
    format!(
        r#"# Made by gonio {version}.
name: Autograding Tests
on:
  - push
  - workflow_dispatch
  - repository_dispatch
permissions:
  checks: write
  actions: read
  contents: read
jobs:
  run-autograding-tests:
    runs-on: ubuntu-latest
    if: github.actor != 'github-classroom[bot]'
    timeout-minutes: 10
    env:
      GONIO_URL: {url}
    steps:
      - name: Checkout code
        uses: actions/checkout@v4
      - name: Install gonio and a software driver for OpenGL
        run: |
          sudo apt-get update -q
          sudo apt-get install -y -q --no-install-recommends {DRIVER_PACKAGES}
          mkdir -p "$RUNNER_TEMP/gonio"
          curl -fsSL "$GONIO_URL" | tar -xz --strip-components=1 -C "$RUNNER_TEMP/gonio"
          echo "$RUNNER_TEMP/gonio" >> "$GITHUB_PATH"
      - name: Check the shaders
        id: gonio
        run: bash .gonio/grade.sh
      - name: Autograding Reporter
        uses: classroom-resources/autograding-grading-reporter@v1
        env:
          GONIO_RESULTS: "${{{{ steps.gonio.outputs.result }}}}"
        with:
          runners: gonio
"#,
        version = request.version
    )
}

fn grade(request: &PackageRequest<'_>) -> String {
    let (id, options) = (shell_quoted(request.id()), request.options());
    let name = serde_json::to_string(request.id()).unwrap_or_default();
    format!(
        r#"#!/usr/bin/env bash
# Made by gonio {version}. Checks the shaders of this repository, and writes the result for Classroom's reporter. It succeeds also if
# they are wrong: the reporter fails then.
set -u
here="$(cd "$(dirname "${{BASH_SOURCE[0]}}")" && pwd)"
gonio="${{GONIO:-gonio}}"
work="$(mktemp -d)"
mkdir "$work/submission"
# Shaders and names.toml, wherever they are; the grader's own files and what was handed out are no answers.
(cd "$here/.." && find . -path ./.git -prune -o -path ./.gonio -prune -o -path ./.github -prune -o -type f \
    \( -name '*.vert' -o -name '*.frag' -o -name '*.glsl' -o -name '*.vs' -o -name '*.fs' -o -name names.toml \) -print0 \
    | xargs -0 -I FILE cp --parents FILE "$work/submission")
# Messages at the lines of a push, and the result for Classroom.
(cd "$work/submission" && timeout --kill-after=10 "${{GONIO_SECONDS:-120}}" "$gonio" lab check {id} . --course "$here/course" \
    {options} --format github --classroom "$work/result.json")
if [ ! -s "$work/result.json" ]; then
    printf '{{"version": 1, "status": "error", "max_score": {points}, "tests": [{{"name": %s, "status": "error", "score": 0, "message": "gonio could not judge these files", "test_code": "", "filename": "", "line_no": 0, "execution_time": 0}}]}}' \
        '{name}' >"$work/result.json"
fi
echo "result=$(base64 -w0 <"$work/result.json")" >>"${{GITHUB_OUTPUT:-/dev/stdout}}"
rm -rf "$work"
"#,
        version = request.version,
        points = request.points()
    )
}

fn students_readme(request: &PackageRequest<'_>) -> String {
    let title = request.of.exercise.title_in(request.language);
    let [read, change, push] = match request.language {
        gonio_language::Language::English => [
            "Read [text.md](text.md).",
            "Change `start.vert` and `start.frag`.",
            "Push. The verdict is under \"Actions\", and messages are at the lines of your commit.",
        ],
        gonio_language::Language::French => [
            "Lisez [text.md](text.md).",
            "Modifiez `start.vert` et `start.frag`.",
            "Poussez (push). Le verdict est sous « Actions », et les messages sont aux lignes de votre commit.",
        ],
    };
    format!("# {title}\n\n1. {read}\n2. {change}\n3. {push}\n")
}

fn readme(request: &PackageRequest<'_>) -> String {
    let id = request.id();
    format!(
        "# {id} on GitHub Classroom\n\n\
         1. Push the content of `upload/` to a repository of your organisation, and mark it as a template.\n\
         2. The workflow downloads gonio from `{}`. Change `GONIO_URL` in `.github/workflows/classroom.yml` if your archive is elsewhere.\n\
         3. Create an assignment with this template. Add no tests of Classroom's own: the workflow is already there. Under \"Protected file \
         paths\" add `.github/**/*` and `.gonio/**/*`: Classroom then marks a submission that changes them.\n\n\
         Students can read and change everything in their repository, also the workflow. The repository therefore has no reference, only \
         pictures of it; and points that matter are better computed again on a machine of yours: `gonio lab check {id} clones/`.\n",
        request.program_url
    )
}
