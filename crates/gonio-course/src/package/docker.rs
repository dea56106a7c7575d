//! A container of one's own: no network, no writing but to `/results`, limits on time, memory and processes.

use super::gradescope::DRIVER_PACKAGES;
use super::{Package, PackageRequest, PackagedFile, shell_quoted};

pub(super) fn package(request: &PackageRequest<'_>) -> Package {
    let mut upload = vec![
        PackagedFile::text("Dockerfile", dockerfile(request)),
        PackagedFile::script("grade.sh", grade(request)),
        PackagedFile::script("run.sh", run(request)),
    ];
    upload.extend(request.course_in("course"));
    if let Some(program) = &request.program {
        upload.push(PackagedFile { path: "gonio".to_owned(), bytes: program.clone(), is_executable: true });
    }
    Package { upload, students: request.start_in(""), readme: readme(request) }
}

fn dockerfile(request: &PackageRequest<'_>) -> String {
    let program = match &request.program {
        Some(_) => "COPY gonio /usr/local/bin/gonio\n".to_owned(),
        None => format!(
            "RUN curl -fsSL {} | tar -xz --strip-components=1 -C /usr/local/bin --wildcards '*/gonio'\n",
            shell_quoted(&request.program_url)
        ),
    };
    format!(
        "# Made by gonio {version}. `run.sh` builds it and checks a submission.\n\
         FROM debian:stable-slim\n\
         RUN apt-get update -q && apt-get install -y -q --no-install-recommends {DRIVER_PACKAGES} ca-certificates curl \\\n    \
         && rm -rf /var/lib/apt/lists/*\n\
         {program}\
         COPY course /course\n\
         COPY grade.sh /grade.sh\n\
         RUN useradd --system --no-create-home grader && gonio lab list --course /course\n\
         USER grader\n\
         ENTRYPOINT [\"/bin/sh\", \"/grade.sh\"]\n",
        version = request.version
    )
}

fn grade(request: &PackageRequest<'_>) -> String {
    let (id, options) = (shell_quoted(request.id()), request.options());
    format!(
        r#"#!/bin/sh
# Made by gonio {version}. Checks the submission in /submission; the verdict is /results/verdict.json, and a page beside it.
# Exit codes: 0 correct, 1 not correct, 2 could not be judged.
set -u
submission="${{SUBMISSION:-/submission}}"
results="${{RESULTS:-/results}}"
course="${{COURSE:-/course}}"
gonio="${{GONIO:-gonio}}"
HOME="${{HOME:-/tmp}}"
export HOME
exec timeout --kill-after=10 "${{GONIO_SECONDS:-120}}" "$gonio" lab check {id} "$submission" --course "$course" \
    {options} --page "$results/verdict.html" --junit "$results/verdict.xml" --json >"$results/verdict.json"
"#,
        version = request.version
    )
}

fn run(request: &PackageRequest<'_>) -> String {
    let image = format!("gonio-{}", request.id());
    format!(
        r#"#!/bin/sh
# Made by gonio {version}. Usage: ./run.sh SUBMISSION RESULTS. Both are folders; RESULTS has to be writable for everybody.
set -eu
here="$(CDPATH='' cd "$(dirname "$0")" && pwd)"
submission="$(CDPATH='' cd "$1" && pwd)"
results="$(CDPATH='' cd "$2" && pwd)"
docker build -q -t {image} "$here" >/dev/null
exec docker run --rm --network none --read-only --tmpfs /tmp:size=64m --cap-drop ALL --security-opt no-new-privileges \
    --memory 2g --cpus 1 --pids-limit 128 -v "$submission:/submission:ro" -v "$results:/results" {image}
"#,
        version = request.version
    )
}

fn readme(request: &PackageRequest<'_>) -> String {
    let id = request.id();
    format!(
        "# {id} in a container\n\n\
         `upload/` has a Dockerfile and scripts:\n\n\
         ```sh\ncd upload\nmkdir -m 777 results\n./run.sh ../submissions/anna results\n```\n\n\
         The container has no network, reads the submission and writes `results` alone, and has limits on memory, processes and time \
         (`run.sh`). `verdict.json` is the verdict, `verdict.html` a page with pictures, `verdict.xml` JUnit. Exit codes: 0 correct, 1 not \
         correct, 2 could not be judged. The image contains no reference.\n\n\
         Give students the files in `students/`.\n"
    )
}
