use super::*;
use glam::DVec3;
use gonio_image::Pixel;

const PICTURES: [Arrangement; 4] =
    [Arrangement::Cross, Arrangement::VerticalCross, Arrangement::Strip, Arrangement::VerticalStrip];
const LAYOUTS: [Layout; 2] = [Layout::OpenGl, Layout::Photographic];

/// Smooth, and different in every direction.
fn smooth(size: u32) -> Cubemap {
    Cubemap::from_function(size, |d| DVec3::new(1.5 + d.x, 1.5 + d.y, 1.5 + d.z))
}

fn distance(a: Pixel, b: Pixel) -> f32 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f32>().sqrt()
}

fn arranged(image: &Image, arrangement: Arrangement, layout: Layout) -> Arranged {
    to_cubemap(image, arrangement, layout).unwrap_or_else(|e| panic!("{e}"))
}

fn picture(map: &Cubemap, arrangement: Arrangement, layout: Layout) -> Image {
    from_cubemap(map, arrangement, layout).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn every_arrangement_comes_back() {
    let map = smooth(5);
    for arrangement in PICTURES {
        for layout in LAYOUTS {
            let image = picture(&map, arrangement, layout);
            let back = arranged(&image, arrangement, layout);
            assert_eq!(back.cubemap, map, "{arrangement} {layout}");
            assert!(back.notes.is_empty() && back.warnings.is_empty(), "{back:?}");
            assert_eq!(recognise(image.width, image.height).arrangement, arrangement);
        }
    }
}

/// The definition of a cross: cells that touch are continuous, in both layouts.
#[test]
fn crosses_are_continuous_across_every_border() {
    let size = 16;
    let map = smooth(size);
    for arrangement in [Arrangement::Cross, Arrangement::VerticalCross] {
        let (across, down) = arrangement.grid().unwrap_or_default();
        for layout in LAYOUTS {
            let image = picture(&map, arrangement, layout);
            let filled = |column: u32, row: u32| arrangement.cells().iter().any(|c| (c.1, c.2) == (column, row));
            let mut borders = 0;
            for (column, row) in (0..across).flat_map(|c| (0..down).map(move |r| (c, r))).filter(|c| filled(c.0, c.1)) {
                for i in 0..size {
                    let beside = (column + 1 < across && filled(column + 1, row)).then(|| {
                        let (x, y) = ((column + 1) * size, row * size + i);
                        distance(image.at(x - 1, y), image.at(x, y))
                    });
                    let below = (row + 1 < down && filled(column, row + 1)).then(|| {
                        let (x, y) = (column * size + i, (row + 1) * size);
                        distance(image.at(x, y - 1), image.at(x, y))
                    });
                    for step in [beside, below].into_iter().flatten() {
                        // Directions of neighbouring texels are at most 2 / 16 apart.
                        assert!(step < 0.125, "{arrangement} {layout}: cell {column} {row}: {step}");
                        borders += 1;
                    }
                }
            }
            // Five borders join six cells.
            assert_eq!(borders, 5 * size, "{arrangement}");
        }
    }
}

/// In the photographic layout the middle is straight ahead, right is right and up is up.
#[test]
fn photographic_crosses_look_as_the_world_does() {
    let map = smooth(4);
    let image = picture(&map, Arrangement::Cross, Layout::Photographic);
    let near = |x: u32, y: u32, d: DVec3| {
        let wanted = d.normalize() + 1.5;
        let found = crate::panorama::color(image.at(x, y));
        // Stored as f32.
        assert!(found.abs_diff_eq(wanted, 1e-6), "{x} {y}: {found} is not {wanted}");
    };
    // Of a size of 4 the middles of texels are at -3/4, -1/4, 1/4, 3/4. Ahead is -Z.
    near(4, 4, DVec3::new(-0.75, 0.75, -1.0));
    near(7, 6, DVec3::new(0.75, -0.25, -1.0));
    // To the right of it +X, where columns go on to +Z; above it +Y, whose lowest row is next to -Z.
    near(8, 4, DVec3::new(1.0, 0.75, -0.75));
    near(7, 3, DVec3::new(0.75, 1.0, -0.75));
    // The last cell is behind.
    near(15, 5, DVec3::new(-0.75, 0.25, 1.0));
}

#[test]
fn a_cross_that_begins_with_the_face_behind_is_told_by_its_empty_cells() {
    let map = smooth(8);
    let cross = picture(&map, Arrangement::Cross, Layout::Photographic);
    // One cell further to the right, the last one first.
    let mut turned = cross.clone();
    turned.pixels.chunks_exact_mut(32).for_each(|row| row.rotate_right(8));
    let back = arranged(&turned, Arrangement::Cross, Layout::Photographic);
    assert_eq!(back.cubemap, map);
    assert_eq!(back.notes, ["the cross begins with the face behind, `negz`"]);
    assert!(back.warnings.is_empty());
    // White instead of black, and a sky of one colour: the corners say what empty is.
    let mut plain = Cubemap::new(8, [0.1, 0.2, 0.9, 1.0]);
    plain.face_mut(Face::NegY).fill([0.0, 0.0, 0.0, 1.0]);
    let mut white = picture(&plain, Arrangement::Cross, Layout::Photographic);
    for (column, row) in [(0, 0), (2, 0), (3, 0), (0, 2), (2, 2), (3, 2)] {
        for y in 0..8 {
            let start = (row * 8 + y) * 32 + column * 8;
            white.pixels[start..start + 8].fill([1.0; 4]);
        }
    }
    assert_eq!(arranged(&white, Arrangement::Cross, Layout::Photographic).cubemap, plain);
    white.pixels.chunks_exact_mut(32).for_each(|row| row.rotate_right(8));
    assert_eq!(arranged(&white, Arrangement::Cross, Layout::Photographic).cubemap, plain);
}

#[test]
fn a_picture_where_nothing_is_empty_is_told() {
    let mut image = Image::new(32, 24, [0.0; 4]);
    for (i, pixel) in image.pixels.iter_mut().enumerate() {
        *pixel = [(i % 32) as f32 / 32.0, (i / 32) as f32 / 24.0, 0.5, 1.0];
    }
    assert_eq!(arranged(&image, Arrangement::Cross, Layout::OpenGl).warnings.len(), 1);
    let upright = Image { width: 24, height: 32, ..image };
    assert_eq!(arranged(&upright, Arrangement::VerticalCross, Layout::OpenGl).warnings.len(), 1);
}

#[test]
fn sizes_mean_what_the_documentation_says() {
    let kind = |width, height| {
        let found = recognise(width, height);
        (found.arrangement, found.warning.is_some())
    };
    assert_eq!(kind(4096, 2048), (Arrangement::Equirectangular, false));
    assert_eq!(kind(4096, 3072), (Arrangement::Cross, false));
    assert_eq!(kind(768, 1024), (Arrangement::VerticalCross, false));
    assert_eq!(kind(6, 1), (Arrangement::Strip, false));
    assert_eq!(kind(1, 6), (Arrangement::VerticalStrip, false));
    // Square, 3:2, and the largest there is.
    for (width, height) in [(512, 512), (600, 400), (u32::MAX, u32::MAX)] {
        assert_eq!(kind(width, height), (Arrangement::Equirectangular, true), "{width} {height}");
    }
    let warning = recognise(600, 400).warning.unwrap_or_default();
    assert!(warning.contains("360 degrees") && warning.contains("180"), "{warning}");
}

#[test]
fn sizes_that_are_no_grid_are_refused() {
    for arrangement in PICTURES {
        let refused = to_cubemap(&Image::new(10, 7, [0.0; 4]), arrangement, Layout::OpenGl).map_err(|e| e.message);
        let message = refused.err().unwrap_or_default();
        assert!(message.contains("10 x 7") && message.contains(arrangement.name()), "{message}");
        assert!(to_cubemap(&Image::default(), arrangement, Layout::OpenGl).is_err());
    }
    for arrangement in [Arrangement::Faces, Arrangement::Equirectangular] {
        assert!(to_cubemap(&Image::new(12, 6, [0.0; 4]), arrangement, Layout::OpenGl).is_err());
        assert!(from_cubemap(&smooth(1), arrangement, Layout::OpenGl).is_err());
    }
}
