//! Each rule about samplers and textures, on a sequence of calls that does just that wrong.

use super::{CORNERS, both, only};
use crate::trace::{DrawSubject, Rule, Severity};

const ONE: &str = "uniform sampler2D picture;\nout vec4 c;\nvoid main() { c = texture(picture, vec2(0.5)); }\n";
const TWO: &str = "uniform sampler2D first;\nuniform sampler2D second;\nout vec4 c;\n\
    void main() { c = texture(first, vec2(0.5)) + texture(second, vec2(0.5)); }\n";
const SKY: &str = "uniform samplerCube around;\nout vec4 c;\nvoid main() { c = texture(around, vec3(1.0)); }\n";
const BOTH_KINDS: &str = "uniform sampler2D picture;\nuniform samplerCube around;\nout vec4 c;\n\
    void main() { c = texture(picture, vec2(0.5)) + texture(around, vec3(1.0)); }\n";

#[test]
fn a_correct_sequence_has_no_finding_and_lists_its_samplers() {
    both(|mut lab| {
        let [red, other] = [lab.texture(0, "red"), lab.texture(3, "other")];
        lab.program(CORNERS, TWO);
        lab.used().set_i32("first", 3);
        lab.used().set_i32("second", 0);
        lab.draw();
        assert_eq!(lab.pixel(), [255, 0, 0, 255]);
        let (record, findings) = lab.finish();
        assert_eq!(findings, []);
        let [draw] = record.draws.as_slice() else { panic!("{} draws", record.draws.len()) };
        let read: Vec<_> = draw.samplers.iter().map(|s| (s.name.as_str(), s.unit, s.texture)).collect();
        assert_eq!(read, [("first", 3, Some(other)), ("second", 0, Some(red))]);
        let texture = record.texture(other).unwrap_or_else(|| panic!("the texture"));
        assert_eq!((texture.name.as_str(), texture.kind.as_str(), texture.width), ("other", "2D", 4));
        assert_eq!(texture.format, "RGBA8");
        let program = &record.programs[0];
        assert!(program.fragment_source.contains("uniform sampler2D second;"), "{program:?}");
        assert_eq!(record.passes[0].target.format.as_deref(), Some("RGBA8"));
    });
}

#[test]
fn a_texture_s_name_for_a_unit() {
    both(|mut lab| {
        // Names are assigned in order; the unit of this number has no texture.
        lab.texture(0, "white");
        let stone = lab.texture(1, "stone");
        lab.program(CORNERS, ONE);
        lab.used().set_i32("picture", stone as i32);
        lab.draw();
        let (_, findings) = lab.finish();
        let finding = only(&findings, Rule::TextureNameAsUnit, 1);
        assert_eq!(finding.severity, Severity::Error);
        let words = format!("was set to {stone}, which is the name of texture {stone}, `stone` and not a unit");
        assert!(finding.message.contains(&words), "{}", finding.message);
        assert!(finding.advice.contains("set it to 1"), "{}", finding.advice);
    });
}

#[test]
fn a_number_beyond_the_units() {
    both(|mut lab| {
        lab.texture(0, "stone");
        lab.program(CORNERS, ONE);
        lab.used().set_i32("picture", 4000);
        lab.draw();
        let (record, findings) = lab.finish();
        let finding = only(&findings, Rule::TextureNameAsUnit, 1);
        let words = format!("was set to 4000, but units go from 0 to {}", record.texture_units - 1);
        assert!(finding.message.contains(&words), "{}", finding.message);
        assert_eq!(record.draws[0].errors, ["INVALID_VALUE"]);
    });
}

#[test]
fn a_sampler_that_was_never_set() {
    both(|mut lab| {
        lab.texture(0, "colour");
        lab.texture(1, "relief");
        lab.program(CORNERS, TWO);
        lab.used().set_i32("first", 0);
        lab.draw();
        let (_, findings) = lab.finish();
        let finding = only(&findings, Rule::SamplerNeverSet, 1);
        assert_eq!(finding.severity, Severity::Error);
        assert!(finding.message.contains("`second` (sampler2D) was never set"), "{}", finding.message);
        assert!(finding.message.contains("`relief` is bound to unit 1"), "{}", finding.message);
        assert!(finding.advice.contains("set it to 1"), "{}", finding.advice);
    });
    both(|mut lab| {
        lab.texture(0, "colour");
        lab.program(CORNERS, ONE);
        lab.draw();
        let (_, findings) = lab.finish();
        assert_eq!(only(&findings, Rule::SamplerNeverSet, 1).severity, Severity::Warning, "it works by luck");
    });
}

#[test]
fn two_types_on_one_unit() {
    both(|mut lab| {
        lab.texture(2, "colour");
        lab.cube(2, "sky");
        lab.program(CORNERS, BOTH_KINDS);
        lab.used().set_i32("picture", 2);
        lab.used().set_i32("around", 2);
        lab.draw();
        let (record, findings) = lab.finish();
        let finding = only(&findings, Rule::TwoSamplerTypes, 1);
        assert!(finding.message.contains("`around` (samplerCube) both read unit 2"), "{}", finding.message);
        // OpenGL itself reports the error, so there is no separate finding.
        assert_eq!(record.draws[0].errors, ["INVALID_OPERATION"]);
    });
}

#[test]
fn a_feedback_loop() {
    both(|mut lab| {
        let id = lab.texture(0, "mirror");
        lab.program(CORNERS, ONE);
        lab.used().set_i32("picture", 0);
        let framebuffer = crate::objects::Framebuffer::bound(lab.gl(), "itself").unwrap_or_else(|e| panic!("{e}"));
        let texture = lab.newest_texture();
        lab.gl().framebuffer_texture_2d(glow::FRAMEBUFFER, glow::COLOR_ATTACHMENT0, glow::TEXTURE_2D, texture, 0);
        lab.draw();
        let (record, findings) = lab.finish();
        let finding = only(&findings, Rule::FeedbackLoop, 1);
        assert!(finding.message.contains("attached as color 0 to `itself`"), "{}", finding.message);
        assert_eq!(record.passes[0].target.attachments[0].texture, Some(id));
        drop(framebuffer);
    });
}

#[test]
fn a_texture_left_over_from_another_material() {
    both(|mut lab| {
        lab.texture(0, "wood");
        lab.program(CORNERS, ONE);
        lab.used().set_i32("picture", 0);
        let subject = |object: &str, material: &str| DrawSubject {
            index: 0,
            object: object.into(),
            part: String::new(),
            material: material.into(),
        };
        {
            let _drawing = lab.gl().drawing(|| subject("table", "wood"));
            lab.bind(0, 0);
            lab.draw();
        }
        {
            let _drawing = lab.gl().drawing(|| subject("chair", "wood"));
            lab.draw();
        }
        {
            let _drawing = lab.gl().drawing(|| subject("cup", "clay"));
            lab.draw();
        }
        let (_, findings) = lab.finish();
        let finding = only(&findings, Rule::StaleTexture, 1);
        assert_eq!((finding.draw, finding.draw_title.as_str()), (2, "cup [clay]"));
        assert!(finding.message.contains("`wood` is left over from `table [wood]`"), "{}", finding.message);
    });
}

#[test]
fn a_texture_left_over_because_another_unit_was_active() {
    both(|mut lab| {
        lab.texture(0, "wood");
        lab.texture(5, "clay");
        lab.bind(0, 0);
        lab.program(CORNERS, ONE);
        lab.used().set_i32("picture", 0);
        lab.draw();
        // Meant for unit 0; but unit 1 is active.
        lab.bind(1, 1);
        lab.draw();
        let (_, findings) = lab.finish();
        let finding = only(&findings, Rule::StaleTexture, 1);
        assert_eq!(finding.draw, 1);
        assert!(finding.message.contains("`wood` is left over from draw 0"), "{}", finding.message);
        assert!(finding.message.contains("`clay` was bound to unit 1"), "{}", finding.message);
    });
}

#[test]
fn a_texture_of_another_kind() {
    both(|mut lab| {
        lab.texture(1, "panorama");
        lab.program(CORNERS, SKY);
        lab.used().set_i32("around", 1);
        lab.draw();
        let (_, findings) = lab.finish();
        let finding = only(&findings, Rule::WrongTextureKind, 1);
        assert!(finding.message.contains("`panorama` is bound, a texture of kind 2D"), "{}", finding.message);
    });
}

#[test]
fn a_unit_with_nothing_bound() {
    both(|mut lab| {
        lab.texture(0, "colour");
        lab.program(CORNERS, ONE);
        lab.used().set_i32("picture", 9);
        lab.draw();
        lab.draw();
        assert_eq!(lab.pixel(), [0, 0, 0, 255], "it reads black");
        let (_, findings) = lab.finish();
        let finding = only(&findings, Rule::UnboundUnit, 2);
        assert!(finding.message.contains("reads unit 9, where no texture is bound"), "{}", finding.message);
    });
}

#[test]
fn a_filter_that_wants_mipmaps_that_are_not_there() {
    both(|mut lab| {
        lab.texture(0, "colour");
        lab.program(CORNERS, ONE);
        lab.used().set_i32("picture", 0);
        let filter = |filter: u32| {
            lab.gl().tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_MIN_FILTER, filter as i32);
        };
        filter(glow::LINEAR_MIPMAP_LINEAR);
        lab.draw();
        assert_eq!(lab.pixel()[0], 0, "it reads black");
        lab.gl().generate_mipmap(glow::TEXTURE_2D);
        lab.draw();
        assert_eq!(lab.pixel()[0], 255, "and now it is complete");
        let (_, findings) = lab.finish();
        let finding = only(&findings, Rule::IncompleteTexture, 1);
        assert_eq!(finding.draw, 0);
        assert!(finding.message.contains("`linear mipmap linear` (it has 1 level of 3)"), "{}", finding.message);
    });
}
