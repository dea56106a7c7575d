//! `--light` and its kin.

use gonio_scene::color_value::Color;
use gonio_scene::description::{LightSourceKind, LightSpec, MaterialOverride, MotionKind};

#[test]
fn a_light_takes_the_keys_of_a_scene_file() {
    let light = LightSpec::from_option_text(
        "spot name=key position=1,2,3 direction=0, -1, 0 color=#ffffff intensity=2 inner-angle=10 quadratic=0.5",
    )
    .unwrap();
    assert_eq!(light.kind, LightSourceKind::Spot);
    assert_eq!(light.name, "key");
    assert_eq!(light.position, Some([1.0, 2.0, 3.0]));
    assert_eq!(light.direction, Some([0.0, -1.0, 0.0]));
    assert_eq!(light.color, Some(Color([1.0; 3])));
    assert_eq!((light.intensity, light.inner_angle, light.quadratic), (Some(2.0), Some(10.0), Some(0.5)));
    let grey = LightSpec::from_option_text("ambient color=0.5 name=3").unwrap();
    assert_eq!((grey.color, grey.name.as_str()), (Some(Color::grey(0.5)), "3"));
}

#[test]
fn a_motion_stands_beside_its_light() {
    let light =
        LightSpec::from_option_text("point position=1,2,1.5 motion=oscillate period=2 amplitude=0,0,2").unwrap();
    let motion = light.motion.unwrap();
    assert_eq!((motion.kind, motion.period, motion.amplitude), (MotionKind::Oscillate, 2.0, Some([0.0, 0.0, 2.0])));
    let light = LightSpec::from_option_text("point motion=path period=4 points=0,0,0;1,0,0;1,1,0").unwrap();
    assert_eq!(light.motion.unwrap().points, Some(vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]));
}

#[test]
fn errors_say_where_in_the_text() {
    let says = |text: &str, expected: &str| {
        assert_eq!(LightSpec::from_option_text(text).unwrap_err(), expected);
    };
    says(
        "point position=1,2,3 colr=1,1,1",
        "`point position=1,2,3 colr=1,1,1`, at 22: unknown key `colr` in a light; did you mean `color`? Known keys: \
         name, position, direction, color, intensity, constant, linear, quadratic, inner_angle, outer_angle, motion, \
         period, amplitude, center, axis, points",
    );
    says(
        "pont position=1,2,3",
        "`pont position=1,2,3`: `kind`: `pont` is no kind of light; did you mean `point`? One of ambient, \
         directional, point, spot is wanted",
    );
    says(
        "point position=1,2",
        "`point position=1,2`, at 16: `position` wants three numbers [x, y, z], got a list of 2",
    );
    says(
        "position=1,2,3",
        "`position=1,2,3`: a light begins with its kind of light: ambient, directional, point or spot",
    );
    says(
        "point position=1,2,3 position=1,2,3",
        "`point position=1,2,3 position=1,2,3`, at 22: `position` is given twice",
    );
    says("point position=", "`point position=`, at 7: `position` has no value; key=value is wanted");
    says("point", "`point`: this point light needs `position`");
    says(
        "ambient position=1,2,3",
        "`ambient position=1,2,3`, at 18: `position` does not belong to an ambient light; it takes kind, name, color, \
         intensity",
    );
    says(
        "point position=1,2,3 period=2",
        "`point position=1,2,3 period=2`, at 22: a light that moves needs motion=oscillate, motion=circle or \
         motion=path",
    );
    says(
        "point position=1,2,3 motion=circle center=0,0,0 period=-2",
        "`point position=1,2,3 motion=circle center=0,0,0 period=-2`, at 56: `period` must be greater than 0, in \
         seconds, not -2",
    );
    says(
        "ambient intensity=nan",
        "`ambient intensity=nan`, at 19: `intensity` must be finite and not negative, not NaN",
    );
}

#[test]
fn a_material_takes_several_keys() {
    let material = MaterialOverride::from_option_text("diffuse=1,0.5,0,shininess=32, textures=false").unwrap();
    assert_eq!(material.diffuse, Some(Color([1.0, 0.5, 0.0])));
    assert_eq!((material.shininess, material.textures), (Some(32.0), Some(false)));
    let error = MaterialOverride::from_option_text("shinyness=3").unwrap_err();
    assert!(error.contains("did you mean `shininess`?"), "{error}");
    let error = MaterialOverride::from_option_text("opacity=2").unwrap_err();
    assert!(error.ends_with("at 9: `opacity` must be 0 to 1, not 2"), "{error}");
}
