//! The fast way to bytes gives what the defined way gives.

use gonio_light::color::{ColorEncoding, OutputTransform, ToneMap};
use gonio_scene::{DisplayMap, Picture};

#[test]
fn bytes_are_those_of_the_display_map() {
    let mut picture = Picture::new(257, 33, [0.0; 4]);
    for (i, pixel) in picture.pixels.iter_mut().enumerate() {
        let v = i as f32 / 8000.0;
        *pixel = match i % 5 {
            0 => [v, v * v, 4.0 * v, 1.0],
            1 => [0.2 * v, 0.1, 0.3 * v, 0.4],
            2 => [v, 0.0, 0.0, 0.0],
            3 => [1e-5 * v, -v, f32::NAN, 1.0],
            _ => [1.0 - 1e-7, 1.0, f32::INFINITY, 1.0],
        };
    }
    for encoding in [ColorEncoding::Srgb, ColorEncoding::Direct] {
        for tone_map in ToneMap::ALL {
            for exposure in [0.0, -1.5, 3.0] {
                let map = DisplayMap::Light(OutputTransform { exposure, tone_map: *tone_map, encoding });
                let got = picture.encode8(&map);
                assert_eq!((got.width, got.height, got.rgba.len()), (257, 33, 257 * 33 * 4));
                for (pixel, bytes) in picture.pixels.iter().zip(got.rgba.as_chunks::<4>().0) {
                    let expected = map.apply(*pixel).map(|v| (v * 255.0 + 0.5) as u8);
                    assert_eq!(*bytes, expected, "{pixel:?} {map:?}");
                }
                let deep = picture.encode16(&map);
                let expected = map.apply(picture.pixels[700]).map(|v| (v * 65535.0 + 0.5) as u16);
                assert_eq!(deep.rgba[2800..2804], expected);
            }
        }
    }
}
