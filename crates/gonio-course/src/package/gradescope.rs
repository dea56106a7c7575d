//! Gradescope: a zip with `setup.sh` and `run_autograder` at its top, as *Autograder Specifications* in Gradescope's documentation
//! describes. Gradescope unpacks it into `/autograder/source`, runs `setup.sh` once when it builds the image, and `run_autograder` for
//! each submission, which lies in `/autograder/submission`; the result is `/autograder/results/results.json`.

use super::{Package, PackageRequest, PackagedFile, shell_quoted};

pub(super) fn package(request: &PackageRequest<'_>) -> Package {
    let mut upload = vec![
        PackagedFile::script("setup.sh", setup(request)),
        PackagedFile::script("run_autograder", run_autograder(request)),
    ];
    upload.extend(request.course_in("course"));
    if let Some(program) = &request.program {
        upload.push(PackagedFile { path: "gonio".to_owned(), bytes: program.clone(), is_executable: true });
    }
    Package { upload, students: request.start_in(""), readme: readme(request) }
}

/// Libraries that a software driver for OpenGL consists of, on Debian and Ubuntu.
pub(super) const DRIVER_PACKAGES: &str = "libegl1 libgl1-mesa-dri";

fn setup(request: &PackageRequest<'_>) -> String {
    let url = shell_quoted(&request.program_url);
    format!(
        r#"#!/usr/bin/env bash
# Made by gonio {version}. Runs once, when Gradescope builds the image: a software driver for OpenGL, and gonio.
set -euo pipefail
source="${{AUTOGRADER_ROOT:-/autograder}}/source"
apt-get update -q
apt-get install -y -q --no-install-recommends {DRIVER_PACKAGES} ca-certificates curl
if [ ! -e "$source/gonio" ]; then
    curl -fsSL {url} | tar -xz --strip-components=1 -C "$source" --wildcards '*/gonio'
fi
chmod +x "$source/gonio" "$source/run_autograder"
# The build of the image fails here rather than each submission later: the files to start from have to be judged, and are wrong.
start="$(mktemp -d)"
"$source/gonio" lab start {id} "$start/files" --course "$source/course"
"$source/gonio" lab check {id} "$start/files" --course "$source/course" || [ $? -eq 1 ]
rm -r "$start"
"#,
        version = request.version,
        id = shell_quoted(request.id())
    )
}

fn run_autograder(request: &PackageRequest<'_>) -> String {
    let (id, options) = (shell_quoted(request.id()), request.options());
    format!(
        r#"#!/usr/bin/env bash
# Made by gonio {version}. Checks one submission, and always writes a results.json.
set -u
root="${{AUTOGRADER_ROOT:-/autograder}}"
gonio="${{GONIO:-$root/source/gonio}}"
results="$root/results/results.json"
mkdir -p "$root/results"
rm -f "$results"
log="$(mktemp)"
# No network and no output of its own; a check that takes too long ends.
timeout --kill-after=10 "${{GONIO_SECONDS:-120}}" "$gonio" lab check {id} "$root/submission" --course "$root/source/course" \
    {options} --gradescope "$results" >"$log" 2>&1
code=$?
if [ ! -s "$results" ]; then
    # gonio could not judge: the reason is one line, as JSON.
    reason="$(grep -m1 '^error: ' "$log" | tr -d '\000-\037' | sed 's/\\/\\\\/g; s/"/\\"/g')"
    printf '{{"score": 0, "output": "gonio could not judge this submission (exit code %s). %s", "visibility": "visible", "stdout_visibility": "hidden", "tests": []}}\n' \
        "$code" "$reason" >"$results"
fi
rm -f "$log"
"#,
        version = request.version
    )
}

fn readme(request: &PackageRequest<'_>) -> String {
    let (id, points) = (request.id(), request.points());
    format!(
        "# {id} on Gradescope\n\n\
         1. Create a programming assignment with {points} autograder points.\n\
         2. Under \"Configure Autograder\", upload the zip: `gonio course package {id} --for gradescope -o {id}.zip`, or the content of \
         `upload/` zipped, with `setup.sh` at its top. The base image is Ubuntu.\n\
         3. \"Test Autograder\" with a right and a wrong submission.\n\
         4. Give students the files in `students/`. They hand in their two shaders.\n\n\
         What students see follows the exercise: `feedback = \"{}\"`. The zip contains no reference.\n",
        request.of.exercise.feedback.word()
    )
}
