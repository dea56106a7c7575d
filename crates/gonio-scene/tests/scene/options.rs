//! `--light` and its kin.

use gonio_light::{Fresnel, Surfaces, fresnel::Medium};
use gonio_scene::color_value::Color;
use gonio_scene::scene_file::{LightSourceKind, LightSpec, MaterialOverride, MotionKind};

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
fn a_light_can_be_off() {
    let off = LightSpec::from_option_text("point off position=1,2,3").unwrap();
    assert_eq!(off.enabled, Some(false));
    assert_eq!(LightSpec::from_option_text("point position=1,2,3 enabled=false").unwrap(), off);
    let on = LightSpec::from_option_text("point position=1,2,3").unwrap();
    assert_eq!(on.enabled, None);
    assert_eq!(
        LightSpec::from_option_text("point off enabled=true position=1,2,3").unwrap_err(),
        "`point off enabled=true position=1,2,3`, at 11: `enabled` is given twice",
    );
}

#[test]
fn errors_say_where_in_the_text() {
    let says = |text: &str, expected: &str| {
        assert_eq!(LightSpec::from_option_text(text).unwrap_err(), expected);
    };
    says(
        "point position=1,2,3 colr=1,1,1",
        "`point position=1,2,3 colr=1,1,1`, at 22: unknown key `colr` in a light; did you mean `color`? Known keys: \
         name, enabled, position, direction, color, intensity, constant, linear, quadratic, inner_angle, outer_angle, \
         motion, period, amplitude, center, axis, points",
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

#[test]
fn names_of_materials_stand_first() {
    let read = |text: &str| MaterialOverride::from_option_text(text).unwrap_or_else(|e| panic!("{e}"));
    let glass = MaterialOverride { medium: Some(Medium::Glass), ..MaterialOverride::default() };
    for text in ["glass", "Glass", "medium=glass"] {
        assert_eq!(read(text), glass, "{text}");
    }
    let mirror = MaterialOverride { reflectivity: Some(1.0), ..MaterialOverride::default() };
    assert_eq!((read("mirror"), read("reflectivity=1")), (mirror.clone(), mirror));
    assert_eq!(read("glass dispersion=0.02"), MaterialOverride { dispersion: Some(0.02), ..glass });
    for (name, medium) in
        [("water", Medium::Water), ("ice", Medium::Ice), ("diamond", Medium::Diamond), ("air", Medium::Air)]
    {
        assert_eq!(read(name).medium, Some(medium));
    }
    let all = read("diamond,fresnel=schlick,surfaces=two,tint=1,0.9,0.8,absorption=0.1 transmission=0.5");
    assert_eq!(
        (all.medium, all.fresnel, all.surfaces),
        (Some(Medium::Diamond), Some(Fresnel::Schlick), Some(Surfaces::Two))
    );
    assert_eq!((all.tint, all.absorption), (Some(Color([1.0, 0.9, 0.8])), Some(Color::grey(0.1))));
    assert_eq!(all.transmission, Some(0.5));

    let says = |text: &str, expected: &str| {
        assert_eq!(MaterialOverride::from_option_text(text).unwrap_err(), expected);
    };
    says(
        "glas",
        "`glas`: `glas` has no value; did you mean `glass`? key=value is wanted, or one of mirror, air, water, ice, \
         glass, diamond",
    );
    says(
        "velvet",
        "`velvet`: `velvet` has no value; key=value is wanted, or one of mirror, air, water, ice, glass, diamond",
    );
    says("glass water", "`glass water`, at 7: `medium` is given twice");
    says("glass medium=water", "`glass medium=water`, at 7: `medium` is given twice");
    says("mirror reflectivity=2", "`mirror reflectivity=2`, at 8: `reflectivity` is given twice");
    says("reflectivity=2", "`reflectivity=2`, at 14: `reflectivity` must be 0 to 1, not 2");
    says("dispersion=3", "`dispersion=3`, at 12: `dispersion` must be -1 to 1, not 3");
    says(
        "tint=1,1,2",
        "`tint=1,1,2`, at 6: `tint` must be 0 to 1 in each channel: a body lets no more light through than comes",
    );
    says(
        "medium=glas",
        "`medium=glas`, at 8: `medium`: `glas` is no medium; did you mean `glass`? One of air, water, ice, glass, \
         diamond is wanted",
    );
}
