//! Colour: the sRGB curve, exposure, tone maps and the way to the picture.

mod support;
use gonio_light::DVec3;
use gonio_light::color::{
    ColorEncoding, EXPOSURE_LIMIT, OutputTransform, RADIANCE_CAP, ToneMap, capped, exposed, srgb_decode,
    srgb_decode_f32, srgb_encode,
};
use support::assert_close;

#[test]
fn srgb_known_values() {
    // IEC 61966-2-1; 0.2158605 is 128/255 decoded, 0.7353570 is 0.5 encoded.
    assert_close(srgb_decode(128.0 / 255.0), 0.215_860_5, 1e-7);
    assert_close(srgb_encode(0.5), 0.735_357_0, 1e-7);
    assert_eq!((srgb_encode(0.0), srgb_decode(0.0)), (0.0, 0.0));
    assert_close(srgb_encode(1.0), 1.0, 1e-15);
    assert_close(srgb_decode(1.0), 1.0, 1e-15);
}

#[test]
fn srgb_round_trip_of_all_bytes_and_the_joint_is_continuous() {
    for byte in 0..=255 {
        let encoded = f64::from(byte) / 255.0;
        assert_close(srgb_encode(srgb_decode(encoded)), encoded, 1e-12);
    }
    // The standard's constants are rounded: its two pieces meet within 4e-8 (set by the standard).
    assert!((srgb_encode(0.0031308) - srgb_encode(0.003_130_800_000_1)).abs() < 4e-8);
}

#[test]
fn single_precision_decodes_the_same() {
    for step in 0..=1000 {
        let encoded = step as f32 / 1000.0;
        // A few units in the last place of f32: the rounding of its power.
        assert_close(srgb_decode_f32(encoded).into(), srgb_decode(encoded.into()), 5e-7);
    }
    assert_eq!([f32::NAN, -1.0, 2.0].map(srgb_decode_f32), [0.0, 0.0, 1.0]);
}

#[test]
fn one_stop_doubles() {
    let light = DVec3::new(0.25, 0.5, 3.0);
    assert_eq!(exposed(light, 1.0), light * 2.0);
    assert_eq!(exposed(light, -2.0), light / 4.0);
    assert_eq!(exposed(light, f64::NAN), light);
    assert_eq!(exposed(light, 1e300), exposed(light, EXPOSURE_LIMIT));
    assert_eq!(exposed(DVec3::ZERO, f64::INFINITY), DVec3::ZERO);
    let hostile = DVec3::new(f64::NAN, -1.0, f64::INFINITY);
    assert_eq!(exposed(hostile, 3.0), DVec3::new(0.0, 0.0, RADIANCE_CAP));
}

#[test]
fn encode_is_exposure_then_tone_map_then_curve() {
    let gray = DVec3::splat(0.5);
    let encode = |tone_map, encoding, exposure| OutputTransform { exposure, tone_map, encoding }.encode(gray).x;
    assert_close(encode(ToneMap::None, ColorEncoding::Srgb, 0.0), srgb_encode(0.5), 1e-15);
    assert_eq!(encode(ToneMap::None, ColorEncoding::Direct, 0.0), 0.5);
    assert_eq!(encode(ToneMap::None, ColorEncoding::Direct, 4.0), 1.0);
    // Reinhard of 0.5 * 2 is 1/2.
    assert_eq!(encode(ToneMap::Reinhard, ColorEncoding::Direct, 1.0), 0.5);
    assert_close(encode(ToneMap::Reinhard, ColorEncoding::Srgb, 1.0), srgb_encode(0.5), 1e-15);
}

#[test]
fn tone_maps_at_known_values() {
    let at = |tone_map: ToneMap, x: f64| tone_map.apply(DVec3::splat(x));
    assert_eq!(at(ToneMap::None, 0.3), DVec3::splat(0.3));
    assert_eq!(at(ToneMap::Reinhard, 3.0), DVec3::splat(0.75));
    // (2.51 + 0.03) / (2.43 + 0.59 + 0.14)
    assert_close(at(ToneMap::Aces, 1.0).y, 2.54 / 3.16, 1e-15);
    // The pivot of AgX's sigmoid: middle grey, 0.18, becomes 0.5 of the display's signal. The tolerance
    // is the polynomial fit's (root of its mean squared error: 0.002 of the signal).
    for channel in at(ToneMap::Agx, 0.18).to_array() {
        assert!((channel.powf(1.0 / 2.2) - 0.5).abs() < 0.004, "{channel}");
    }
}

#[test]
fn tone_maps_rise_from_black_to_white_and_stay_in_range() {
    for &tone_map in ToneMap::ALL {
        assert_eq!(tone_map.apply(DVec3::ZERO), DVec3::ZERO, "{tone_map}");
        assert!(tone_map.apply(DVec3::splat(RADIANCE_CAP)).min_element() > 0.99, "{tone_map}");
        for hue in [DVec3::ONE, DVec3::new(1.0, 0.5, 0.1), DVec3::X] {
            let mut last = DVec3::ZERO;
            for step in -600..=600 {
                let display = tone_map.apply(hue * (f64::from(step) / 30.0).exp2());
                assert!(display.min_element() >= 0.0 && display.max_element() <= 1.0, "{tone_map}: {display}");
                if hue == DVec3::ONE {
                    assert!((display - last).min_element() >= 0.0, "{tone_map} falls at 2^({step}/30)");
                }
                last = display;
            }
        }
    }
}

#[test]
fn agx_turns_bright_red_towards_white_and_keeps_grey_grey() {
    let red = ToneMap::Agx.apply(DVec3::new(30.0, 0.0, 0.0));
    assert!(red.x > 0.9 && red.y > 0.1, "{red}");
    let grey = ToneMap::Agx.apply(DVec3::splat(0.4));
    // The matrices' rows sum to 1 within 3e-4 only.
    assert!(grey.max_element() - grey.min_element() < 1e-3, "{grey}");
}

#[test]
fn nothing_gets_through_but_numbers_from_0_to_1() {
    let hostile = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, f64::MAX, f64::MIN, 1e-320, 0.0, 0.5];
    for &tone_map in ToneMap::ALL {
        for &encoding in ColorEncoding::ALL {
            for exposure in [0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 3.0] {
                for x in hostile {
                    for y in hostile {
                        let out = OutputTransform { exposure, tone_map, encoding }.encode(DVec3::new(x, y, 0.5));
                        let range = 0.0..=1.0;
                        assert!(out.to_array().iter().all(|c| range.contains(c)), "{tone_map} {x} {y}: {out}");
                    }
                }
            }
        }
    }
    for x in hostile {
        assert!((0.0..=1.0).contains(&srgb_encode(x)) && (0.0..=1.0).contains(&srgb_decode(x)), "{x}");
    }
    assert_eq!(capped(DVec3::new(f64::NAN, -2.0, f64::INFINITY)), DVec3::new(0.0, 0.0, RADIANCE_CAP));
    assert_eq!(capped(DVec3::new(0.1, 2.0, 1e29)), DVec3::new(0.1, 2.0, 1e29));
}
