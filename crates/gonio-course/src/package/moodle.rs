//! Moodle without CodeRunner: a question of type essay, to which students attach their files. Moodle cannot judge them; the teacher
//! downloads all answers and checks them at once.

use super::xml::{cdata, escaped, question_text};
use super::{Package, PackageRequest, PackagedFile};

/// Most bytes of an attachment: a shader has a few thousand.
const MOST_BYTES: u32 = 1 << 20;

pub(super) fn package(request: &PackageRequest<'_>) -> Package {
    let students = request.start_in("");
    let upload = vec![PackagedFile::text("question.xml", question(request, &students))];
    Package { upload, students, readme: readme(request) }
}

fn question(request: &PackageRequest<'_>, students: &[PackagedFile]) -> String {
    let exercise = &request.of.exercise;
    let given: Vec<(String, Vec<u8>)> = students
        .iter()
        .filter(|file| file.path != "text.md")
        .map(|file| (file.path.clone(), file.bytes.clone()))
        .collect();
    let mut markdown = exercise.text_in(request.language).to_owned();
    let heading = match request.language {
        gonio_language::Language::English => "Files to start from",
        gonio_language::Language::French => "Les fichiers de départ",
    };
    markdown += &format!("\n\n## {heading}\n\n");
    for (name, _) in &given {
        markdown += &format!("- [{name}]({name})\n");
    }
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<quiz>\n<question type=\"essay\">\n<name>\n<text>{name}</text>\n</name>\n\
         {text}<generalfeedback format=\"html\">\n<text></text>\n</generalfeedback>\n<defaultgrade>{points}</defaultgrade>\n\
         <penalty>0</penalty>\n<hidden>0</hidden>\n<idnumber>{id}</idnumber>\n<responseformat>noinline</responseformat>\n\
         <responserequired>0</responserequired>\n<responsefieldlines>10</responsefieldlines>\n<minwordlimit></minwordlimit>\n\
         <maxwordlimit></maxwordlimit>\n<attachments>3</attachments>\n<attachmentsrequired>1</attachmentsrequired>\n\
         <maxbytes>{MOST_BYTES}</maxbytes>\n<filetypeslist>.vert,.frag,.glsl,.vs,.fs,.txt,.toml,.zip</filetypeslist>\n\
         <graderinfo format=\"html\">\n<text>{info}</text>\n</graderinfo>\n<responsetemplate format=\"html\">\n<text></text>\n\
         </responsetemplate>\n</question>\n</quiz>\n",
        name = escaped(exercise.title_in(request.language)),
        text = question_text(&markdown, &given),
        points = request.points(),
        id = escaped(request.id()),
        info = cdata(&format!("gonio lab check {} ANSWERS", request.id())),
    )
}

fn readme(request: &PackageRequest<'_>) -> String {
    let (id, points) = (request.id(), request.points());
    format!(
        "# {id} in Moodle, without CodeRunner\n\n\
         Moodle itself cannot run gonio, so nobody is graded while you sleep. Two ways:\n\n\
         **A quiz.** Question bank, Import, Moodle XML, `upload/question.xml`: an essay question of {points} points, to which students attach \
         their shaders. After the quiz: Results, Responses, \"Download essay submissions\".\n\n\
         **An assignment.** Add an assignment with file submissions, {points} points, and attach the files in `students/`. After the deadline: \
         \"Download all submissions\".\n\n\
         Then check the download as it is, and take the points from the table:\n\n\
         ```sh\ngonio lab check {id} submissions.zip -o results\n```\n\n\
         With CodeRunner, Moodle does it at once: `--for coderunner`.\n"
    )
}
