//! Pictures and cubemaps of every format, detected by their content, also as crosses and strips.

#![no_main]

use gonio_environment::{Arrangement, Layout, arrange};
use gonio_image::DecodeLimits;
use gonio_image::decode::{DecodedContent, decode};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    // So tight that a hundred bytes cannot allocate gigabytes unnoticed.
    let Ok(decoded) = decode("input", data, &DecodeLimits { max_bytes: 1 << 24 }) else { return };
    let images = match &decoded.shape {
        DecodedContent::Picture(image) => std::slice::from_ref(image),
        DecodedContent::Faces(faces) => &faces[..],
    };
    for image in images {
        assert_eq!(image.pixels.len(), image.width as usize * image.height as usize);
        assert!(image.pixels.iter().all(|p| p[..3].iter().all(|x| *x >= 0.0 && x.is_finite()) && p[3] == 1.0));
    }
    for (image, arrangement) in images.iter().flat_map(|i| Arrangement::ALL.iter().map(move |a| (i, *a))) {
        if let Ok(arranged) = arrange::to_cubemap(image, arrangement, Layout::Photographic)
            && arranged.notes.is_empty()
        {
            let back = arrange::from_cubemap(&arranged.cubemap, arrangement, Layout::Photographic);
            assert!(back.is_ok_and(|b| (b.width, b.height) == (image.width, image.height)));
        }
    }
});
