//! A right answer, made by gonio-bake, and changes of it.

use gonio_atlas::{AtlasUv, UnwrapSettings, unwrap};
use gonio_bake::model::{AtlasSet, MapFile, baked_model};
use gonio_bake::{BakeSettings, BakedMap, Baker, MapKind, SceneSurface};
use gonio_check::submission::SourceFile;
use gonio_image::EncodedPicture;
use gonio_image::encode::png::{ColorTag, encode8};
use gonio_image::srgb::ENCODER;
use gonio_light::color::srgb_decode;
use gonio_mesh::{Model, write};
use gonio_scene::files::BuiltinOnly;
use gonio_scene::{Scene, load};
use std::path::Path;

/// A layout and a size.
#[derive(Clone, Debug, PartialEq)]
pub struct Recipe {
    pub unwrap: UnwrapSettings,
    pub size: u32,
    /// Samples along a side of a texel.
    pub grid: u32,
}

impl Default for Recipe {
    fn default() -> Self {
        Recipe { unwrap: UnwrapSettings::default(), size: 512, grid: 1 }
    }
}

/// The files of an answer before they are written.
#[derive(Clone)]
pub struct Case {
    pub recipe: Recipe,
    pub model: Model,
    /// Linear colours, first row at the bottom.
    pub picture: Vec<[f64; 3]>,
    pub covered: Vec<bool>,
    /// The light that falls on each texel, the emission, and a colour for each part.
    pub light: Vec<[f64; 3]>,
    pub emitted: Vec<[f64; 3]>,
    pub ids: Vec<[f64; 3]>,
    /// Whether the picture's numbers are written without encoding.
    pub is_data: bool,
    pub has_picture: bool,
    pub has_library: bool,
    pub replaced: Vec<(String, String)>,
    pub replaced_in_obj: Vec<(String, String)>,
    pub beside: Vec<SourceFile>,
}

fn scene() -> Scene {
    let files = &BuiltinOnly;
    let described = load::describe(&["builtin:still-life"], files).unwrap();
    load::load(described, Path::new(""), files).unwrap()
}

/// Bakes the still life.
pub fn baked(recipe: Recipe) -> Case {
    with_layout(recipe, &|_| ())
}

/// Bakes it after its coordinates were changed.
pub fn with_layout(recipe: Recipe, change: &dyn Fn(&mut AtlasUv)) -> Case {
    let scene = scene();
    let surface = SceneSurface::new(&scene);
    let mut atlas = unwrap(&surface.mesh, &recipe.unwrap, &|_| true).unwrap();
    change(&mut atlas);
    let frame = scene.frame(0.0);
    let settings = BakeSettings { size: recipe.size, grid: recipe.grid, ..BakeSettings::default() };
    let mut baker = Baker::new(&scene, &frame, &surface, &atlas, settings);
    let mut bake = |kind: MapKind| baker.bake(kind, &|_| true).unwrap();
    let (diffuse, id) = (bake(MapKind::Diffuse), bake(MapKind::Id));
    let colors =
        |map: &BakedMap| map.texels.values.iter().map(|[r, g, b, _]| [*r, *g, *b].map(f64::from)).collect::<Vec<_>>();
    let file = MapFile { kind: MapKind::Diffuse, name: "baked.png".to_owned(), factor: 1.0 };
    let model = baked_model(&scene, &surface, &atlas, &[file], AtlasSet::Only).model;
    Case {
        recipe,
        model,
        picture: colors(&diffuse),
        covered: id.texels.covered.clone(),
        light: colors(&bake(MapKind::Light)),
        emitted: colors(&bake(MapKind::Emitted)),
        ids: colors(&id),
        is_data: false,
        has_picture: true,
        has_library: true,
        replaced: Vec::new(),
        replaced_in_obj: Vec::new(),
        beside: Vec::new(),
    }
}

impl Case {
    pub fn side(&self) -> usize {
        self.recipe.size as usize
    }

    /// Makes texels farther than `margin` texels from a chart black.
    pub fn cut_margin(&mut self, margin: i64) {
        let side = self.side() as i64;
        let is_near = |index: usize| {
            let (x, y) = (index as i64 % side, index as i64 / side);
            (-margin..=margin).any(|dy| {
                (-margin..=margin).any(|dx| {
                    let (x, y) = (x + dx, y + dy);
                    (0..side).contains(&x) && (0..side).contains(&y) && self.covered[(y * side + x) as usize]
                })
            })
        };
        let far: Vec<usize> = (0..self.picture.len()).filter(|&index| !is_near(index)).collect();
        far.into_iter().for_each(|index| self.picture[index] = [0.0; 3]);
    }

    /// The texel at each place comes from another place.
    pub fn move_texels(&mut self, from: impl Fn(usize, usize) -> (usize, usize)) {
        let (side, old) = (self.side(), self.picture.clone());
        for (index, texel) in self.picture.iter_mut().enumerate() {
            let (x, y) = from(index % side, index / side);
            *texel = old[y * side + x];
        }
    }

    /// Changes each colour, given the light, the emission and the part there.
    pub fn recolor(&mut self, color: impl Fn([f64; 3], usize, &Case) -> [f64; 3]) {
        let old = self.clone();
        for (index, texel) in self.picture.iter_mut().enumerate() {
            *texel = color(*texel, index, &old);
        }
    }

    /// The colour in `ids` of a part, by its number.
    pub fn id_of(&self, part: usize) -> [f64; 3] {
        let corners = {
            let part = &self.model.mesh.parts[part];
            self.model.mesh.triangle(part.first_triangle).map(|i| self.model.mesh.tex_coords[i])
        };
        let at = |k: usize| corners.iter().map(|c| f64::from(c[k])).sum::<f64>() / 3.0 * self.side() as f64;
        self.ids[at(1) as usize * self.side() + at(0) as usize]
    }

    /// Removes a part from the model.
    pub fn remove_part(&mut self, part: usize) {
        let mesh = &mut self.model.mesh;
        let removed = mesh.parts.remove(part);
        let range = 3 * removed.first_triangle..3 * (removed.first_triangle + removed.triangle_count);
        mesh.indices.drain(range);
        mesh.smoothing_groups = Vec::new();
        for later in &mut mesh.parts[part..] {
            later.first_triangle -= removed.triangle_count;
        }
    }

    pub fn picture_file(&self) -> Vec<u8> {
        let side = self.side();
        let byte = |value: f64| match self.is_data {
            true => (value.clamp(0.0, 1.0) * 255.0).round() as u8,
            false => ENCODER.encode_f64(value.clamp(0.0, 1.0)),
        };
        let rows = self.picture.chunks(side).rev().flatten();
        let rgba = rows.flat_map(|color| {
            let [r, g, b] = color.map(byte);
            [r, g, b, 255]
        });
        let size = self.recipe.size;
        encode8(&EncodedPicture { width: size, height: size, rgba: rgba.collect() }, ColorTag::Srgb).unwrap()
    }

    /// The files as they are handed in.
    pub fn files(&self) -> Vec<SourceFile> {
        let written = write::obj::write(&self.model, "baked.mtl");
        let change = |bytes: Vec<u8>, changes: &[(String, String)]| {
            let mut text = String::from_utf8(bytes).unwrap();
            for (old, new) in changes {
                assert!(text.contains(old), "{old}");
                text = text.replace(old, new);
            }
            text
        };
        let mut files = self.beside.clone();
        files.push(SourceFile::new("baked.obj", change(written.obj, &self.replaced_in_obj)));
        if self.has_library {
            files.push(SourceFile::new("baked.mtl", change(written.mtl, &self.replaced)));
        }
        if self.has_picture {
            files.push(SourceFile::new("baked.png", self.picture_file()));
        }
        files
    }

    /// The same as one binary file.
    pub fn glb(&self) -> Vec<SourceFile> {
        let picture = self.picture_file();
        let glb = write::glb::write(&self.model, &mut |_| Some(picture.clone())).unwrap();
        vec![SourceFile::new("baked.glb", glb.bytes)]
    }
}

/// A number that was encoded once more.
pub fn encoded_twice(linear: f64) -> f64 {
    f64::from(ENCODER.encode_f64(linear.clamp(0.0, 1.0))) / 255.0
}

/// A number that was not encoded: as if a program decoded it once more.
pub fn not_encoded(linear: f64) -> f64 {
    srgb_decode(linear.clamp(0.0, 1.0))
}
