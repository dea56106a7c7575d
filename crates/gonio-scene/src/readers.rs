//! The readers that loading a scene uses. A program links those that it names, and no others.

use crate::environment_file::{self, ReadEnvironment};
use crate::files::{Budget, Budgeted, FileSource};
use crate::image_file::{self, Decoded, MAX_TEXTURE_SIDE};
use crate::input_kind;
use crate::material_brdf::BrdfLibrary;
use crate::model_file;
use crate::part_material::{self, NamedParts, PartName};
use crate::scene_file::{EnvironmentSpec, MaterialOverride, ObjectSpec};
use gonio_mesh::{Diagnostic, Format, Limits, Mesh, Model, ReadError, Sidecars, obj, tangents};
use std::path::Path;

type Unpack = fn(&[u8], &Limits, &Budget) -> Result<Option<Vec<u8>>, ReadError>;
type ReadModel = fn(Format, &[u8], &mut dyn Sidecars, &Limits) -> Result<Model, ReadError>;
type ReadEnvironmentOf = fn(&EnvironmentSpec, &Path, &Budgeted<&dyn FileSource>) -> Result<ReadEnvironment, ReadError>;
type ReadBrdf =
    fn(&mut BrdfLibrary, &MaterialOverride, &Path, &dyn FileSource, &mut Vec<Diagnostic>) -> Result<(), ReadError>;

type OwnMaterial = fn(PartName<'_>, &ObjectSpec) -> Option<MaterialOverride>;

/// Readers of the files of a scene.
///
/// [`Readers::ALL`] reads everything. The web page's first picture is drawn by a module of its own, for which every
/// reader that it does not need would be a longer wait.
pub struct Readers {
    pub(crate) unpack: Unpack,
    /// The format of a model with these bytes and this name.
    pub(crate) format: fn(&[u8], &str) -> Result<Format, String>,
    pub(crate) model: ReadModel,
    pub(crate) pictures: PictureReader,
    /// A mesh with tangents; `None` where it has no texture coordinates.
    pub(crate) tangents: fn(&Mesh) -> Option<Mesh>,
    pub(crate) environment: ReadEnvironmentOf,
    pub(crate) brdf: ReadBrdf,
    /// The values of an object's material for one part, if it has some.
    pub(crate) own_material: OwnMaterial,
    /// Warnings about names of parts that no model has.
    pub(crate) unknown_parts: fn(&[ObjectSpec], &[NamedParts<'_>]) -> Vec<Diagnostic>,
}

/// The reader of textures.
#[derive(Clone, Copy)]
pub(crate) struct PictureReader {
    /// Bytes that decoding takes, if the header of the file shows it.
    pub memory: fn(&[u8], &str) -> Option<u64>,
    pub decode: fn(&[u8], &str) -> Result<Decoded, String>,
}

impl PictureReader {
    pub const ALL: PictureReader = PictureReader { memory: image_file::memory, decode: image_file::decode };
}

impl Readers {
    /// Every format.
    pub const ALL: &Readers = &Readers {
        unpack: model_file::unpack,
        format: input_kind::format_of,
        model: Format::read,
        pictures: PictureReader::ALL,
        tangents: tangents::with_tangents,
        environment: |spec, base, files| environment_file::load(spec, base, files),
        brdf: |brdfs, material, base, files, diagnostics| brdfs.add(material, base, files, diagnostics),
        own_material: |part, object| part.material_in(object),
        unknown_parts: part_material::unknown_parts,
    };

    /// Plain OBJ models with textures that are decoded already ([`decoded_picture`]); no normal maps, no environments, no
    /// BRDFs, and no materials of single parts.
    pub const OBJ: &Readers = &Readers {
        unpack: |_, _, _| Ok(None),
        format: |_, _| Ok(Format::Obj),
        model: |_, bytes, sidecars, limits| obj::read(bytes, sidecars, limits),
        pictures: PictureReader { memory: |bytes, _| Some(bytes.len() as u64), decode: |bytes, _| decoded(bytes) },
        tangents: |_| None,
        environment: |_, _, _| Err(ReadError::new("environments cannot be read yet")),
        brdf: |_, _, _, _, _| Ok(()),
        own_material: |_, _| None,
        unknown_parts: |_, _| Vec::new(),
    };
}

/// The file that [`Readers::OBJ`] expects in place of a picture file: width, height, and `rgba`, the texels as
/// `width * height * 4` bytes, first row the top one.
pub fn decoded_picture(width: u32, height: u32, rgba: &[u8]) -> Vec<u8> {
    [&width.to_le_bytes(), &height.to_le_bytes(), rgba].concat()
}

/// The picture in a file of [`decoded_picture`].
fn decoded(bytes: &[u8]) -> Result<Decoded, String> {
    let header = bytes.split_first_chunk().and_then(|(width, rest)| Some((width, rest.split_first_chunk()?)));
    let Some((width, (height, rgba))) = header else { return Err("the picture has no header".into()) };
    let [width, height] = [width, height].map(|side| u32::from_le_bytes(*side));
    let fits = [width, height].iter().all(|side| (1..=MAX_TEXTURE_SIDE).contains(side));
    if !fits || rgba.len() as u64 != 4 * u64::from(width) * u64::from(height) {
        return Err(format!("{} bytes are not {width} x {height} texels", rgba.len()));
    }
    let has_alpha = rgba.as_chunks::<4>().0.iter().any(|texel| texel[3] != 255);
    Ok(Decoded { width, height, rgba: rgba.to_vec(), has_alpha })
}
