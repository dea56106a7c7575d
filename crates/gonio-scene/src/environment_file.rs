//! Environments from files: a picture, a folder, six faces, or a name that is built in.

use crate::environment::LoadedEnvironment;
use crate::files::{self, Budgeted, FileSource};
use crate::input_kind;
use crate::scene_file::EnvironmentSpec;
use crate::toml_table::nearest_word;
use gonio_environment::arrange::{self, Arrangement};
use gonio_environment::builtin::{self, Builtin};
use gonio_environment::convert::{Conversion, EnvironmentRef};
use gonio_environment::names::{self, Assignment};
use gonio_environment::{Cubemap, EnvironmentError, Face, Layout, Panorama};
use gonio_image::Image;
use gonio_image::decode::{Decoded, DecodedContent, FileFormat, decode};
use gonio_mesh::{Cause, Diagnostic, Limits, ReadError};
use gonio_threads::prelude::*;
use std::path::{Path, PathBuf};

/// The map of an environment.
#[derive(Clone, Debug, PartialEq)]
pub enum EnvironmentMap {
    /// Six faces.
    Cubemap(Cubemap),
    /// An equirectangular picture.
    Panorama(Panorama),
}

impl EnvironmentMap {
    /// Returns the map as the input of a conversion.
    pub fn as_environment(&self) -> EnvironmentRef<'_> {
        match self {
            EnvironmentMap::Cubemap(map) => EnvironmentRef::Cubemap(map),
            EnvironmentMap::Panorama(panorama) => EnvironmentRef::Panorama(panorama),
        }
    }
}

/// An environment that was read from its files.
#[derive(Clone, Debug)]
pub struct OpenedEnvironment {
    /// The name that the user gave.
    pub name: String,
    /// Its radiance.
    pub map: EnvironmentMap,
    /// The arrangement of the faces in the files.
    pub arrangement: Arrangement,
    /// The layout of the faces; `None` for a panorama.
    pub layout: Option<Layout>,
    /// The files, in the order of [`Face::ALL`] if there are six; empty for a built-in environment.
    pub files: Vec<PathBuf>,
    /// Whether the file format can hold radiance above 1.
    pub high_dynamic_range: bool,
    /// The format of the file, or of the first of six; `None` for a built-in environment.
    pub format: Option<FileFormat>,
    /// Warnings and notes.
    pub diagnostics: Vec<Diagnostic>,
}

/// Options for opening an environment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EnvironmentReadOptions {
    /// The layout of the faces. By default photographic for six files, a cross or a strip, and OpenGL's for KTX2 and
    /// DDS, as these formats define.
    pub layout: Option<Layout>,
    /// The arrangement of a single picture; by default it follows from the proportions.
    pub arrangement: Option<Arrangement>,
    /// Texels along an edge of built-in environments that exist in any size; [`BUILTIN_SIZE`] by default.
    pub size: Option<u32>,
}

/// Default size of built-in environments, texels along an edge.
pub const BUILTIN_SIZE: u32 = 512;
/// The largest default size of the cubemap that a panorama is converted to.
pub const USUAL_SIZE_MAX: u32 = 1024;

/// The built-in environment of a name: `sky`, or `builtin:sky`.
pub fn builtin_of(name: &str) -> Option<Builtin> {
    name.strip_prefix(files::BUILTIN).unwrap_or(name).parse().ok()
}

/// The environment `name` of a scene file in `base`, relative to the current folder.
pub(crate) fn rebased(base: &Path, name: &str) -> String {
    if builtin_of(name).is_some() {
        return name.to_owned();
    }
    files::resolve(base, name).to_string_lossy().into_owned()
}

/// Reads what `name` names, relative to `base`: a built-in environment, a picture, a folder or a pattern of six faces,
/// or one of six faces.
///
/// # Errors
///
/// A file that is not there or cannot be read; files and their pixels that need more than `limits.max_bytes` together;
/// faces that are missing, or do not fit together; an arrangement or a size that the environment cannot have.
pub fn open(
    name: &str,
    options: EnvironmentReadOptions,
    base: &Path,
    files: &dyn FileSource,
    limits: &Limits,
) -> Result<OpenedEnvironment, ReadError> {
    let mut opened = open_within(name, options, base, &Budgeted::new(files, limits.max_bytes))?;
    let unused = options.layout.is_some() && opened.layout.is_none();
    opened.diagnostics.extend(unused.then(|| layout_unused(name)));
    Ok(opened)
}

/// Warns about a layout that has no effect.
fn layout_unused(name: &str) -> Diagnostic {
    Diagnostic::warning("the layout has no effect: this environment has no faces").in_file(name)
}

/// [`open`] without the warning about an unused layout.
fn open_within<S: FileSource>(
    name: &str,
    options: EnvironmentReadOptions,
    base: &Path,
    files: &Budgeted<S>,
) -> Result<OpenedEnvironment, ReadError> {
    let opened = if let Some(kind) = builtin_of(name) {
        let mut opened =
            open_builtin(name, kind, options, files, &limits_of(files)).map_err(|e| read_error(e, name))?;
        if !name.starts_with(files::BUILTIN) && !files::list(files, &files::resolve(base, name)).is_empty() {
            let message = format!("this names the built-in environment; write ./{name} for the folder");
            opened.diagnostics.push(Diagnostic::note(message).in_file(name));
        }
        opened
    } else if let Some(unknown) = name.strip_prefix(files::BUILTIN) {
        return Err(ReadError::new(no_builtin(unknown)).in_file(name));
    } else {
        open_files(name, &Reader { options, files }, &files::resolve(base, name))?
    };
    match options.arrangement {
        Some(requested) if requested != opened.arrangement => {
            let (found, requested) = (opened.arrangement, requested.name());
            let message =
                format!("this is already {found} and cannot be read as {requested}; leave the arrangement out");
            Err(ReadError::new(message).in_file(name))
        }
        _ => Ok(opened),
    }
}

/// The memory that is left for pixels.
fn limits_of<S: FileSource>(files: &Budgeted<S>) -> gonio_image::DecodeLimits {
    gonio_image::DecodeLimits { max_bytes: files.budget().left() }
}

fn open_files<S: FileSource>(name: &str, reader: &Reader<'_, S>, path: &Path) -> Result<OpenedEnvironment, ReadError> {
    if let Some(pattern) = path.file_name().and_then(|n| n.to_str()).filter(|n| n.contains('*')) {
        return reader.open_pattern(name, path.parent().unwrap_or(Path::new("")), pattern);
    }
    let within = files::list(reader.files, path);
    if within.is_empty() { reader.open_file(name, path) } else { reader.open_folder(name, path, within) }
}

/// Explains that a built-in environment does not exist, and lists those that do.
fn no_builtin(name: &str) -> String {
    let meant = nearest_builtin(name).map_or(String::new(), |known| format!("; did you mean `{known}`?"));
    let names = Builtin::ALL.iter().map(|b| b.name()).collect::<Vec<_>>().join(", ");
    format!("unknown built-in environment `{name}`: expected one of {names}{meant}")
}

fn nearest_builtin(name: &str) -> Option<&'static str> {
    nearest_word(name, Builtin::ALL.iter().map(|b| b.name()))
}

fn open_builtin(
    name: &str,
    kind: Builtin,
    options: EnvironmentReadOptions,
    files: &dyn FileSource,
    limits: &gonio_image::DecodeLimits,
) -> Result<OpenedEnvironment, EnvironmentError> {
    let layout = options.layout.unwrap_or_default();
    let size = options.size.unwrap_or(BUILTIN_SIZE);
    limits.pixels(size.into(), size.into(), 6)?;
    let (source, arrangement) = match kind {
        Builtin::Room => {
            let room = match files.builtin(builtin::ROOM_FILE) {
                Some(bytes) => builtin::room_from(&bytes)?,
                None => builtin::room()?,
            };
            (EnvironmentMap::Panorama(room), Arrangement::Equirectangular)
        }
        _ => (EnvironmentMap::Cubemap(kind.cubemap(size, layout)?), Arrangement::Faces),
    };
    Ok(OpenedEnvironment {
        name: name.to_owned(),
        layout: (kind == Builtin::Debug).then_some(layout),
        map: source,
        arrangement,
        files: Vec::new(),
        high_dynamic_range: kind != Builtin::Debug,
        format: None,
        diagnostics: Vec::new(),
    })
}

struct Reader<'a, S> {
    options: EnvironmentReadOptions,
    files: &'a Budgeted<S>,
}

impl<S: FileSource> Reader<'_, S> {
    fn open_folder(&self, name: &str, folder: &Path, within: Vec<PathBuf>) -> Result<OpenedEnvironment, ReadError> {
        let names = sorted_names(within);
        let assignment = names::assign(&names).map_err(|e| read_error(e, name))?;
        self.open_faces(name, folder, &names, assignment)
    }

    fn open_pattern(&self, name: &str, folder: &Path, pattern: &str) -> Result<OpenedEnvironment, ReadError> {
        let names = sorted_names(files::list(self.files, folder));
        let names: Vec<String> = names.into_iter().filter(|n| matches(pattern, n)).collect();
        if names.is_empty() {
            return Err(ReadError::new("no file matches this pattern").in_file(name));
        }
        let assignment = names::assign(&names).map_err(|e| read_error(e, name))?;
        self.open_faces(name, folder, &names, assignment)
    }

    fn open_file(&self, name: &str, path: &Path) -> Result<OpenedEnvironment, ReadError> {
        let decoded = self.decode(name, path, &limits_of(self.files))?;
        let bytes = memory(&decoded);
        let mut opened = OpenedEnvironment {
            name: name.to_owned(),
            map: EnvironmentMap::Cubemap(Cubemap::new(1, [0.0; 4])),
            arrangement: Arrangement::Faces,
            layout: None,
            files: vec![path.to_owned()],
            high_dynamic_range: decoded.high_dynamic_range,
            format: Some(decoded.format),
            diagnostics: diagnostics_of(&decoded, name),
        };
        let warn = |opened: &mut OpenedEnvironment, warning: String| {
            opened.diagnostics.push(Diagnostic::warning(warning).in_file(name));
        };
        match decoded.shape {
            DecodedContent::Faces(faces) => {
                let layout = self.options.layout.unwrap_or(Layout::OpenGl);
                opened.layout = Some(layout);
                let map = Cubemap::from_faces(*faces, layout).map_err(|e| read_error(e, name))?;
                opened.map = EnvironmentMap::Cubemap(map);
            }
            DecodedContent::Picture(image) => {
                if image.width == image.height && self.options.arrangement.is_none_or(|a| a == Arrangement::Faces) {
                    return self.open_with_siblings(name, path);
                }
                let recognised = arrange::recognise(image.width, image.height);
                let arrangement = self.options.arrangement.unwrap_or(recognised.arrangement);
                if let Some(warning) = recognised.warning.filter(|_| arrangement == recognised.arrangement) {
                    warn(&mut opened, warning);
                }
                opened.arrangement = arrangement;
                if arrangement == Arrangement::Equirectangular {
                    opened.map = EnvironmentMap::Panorama(Panorama::new(image).map_err(|e| read_error(e, name))?);
                } else if arrangement == Arrangement::Faces {
                    return self.open_with_siblings(name, path);
                } else {
                    let layout = self.options.layout.unwrap_or(Layout::Photographic);
                    opened.layout = Some(layout);
                    let arranged = arrange::to_cubemap(&image, arrangement, layout).map_err(|e| read_error(e, name))?;
                    let notes = arranged.notes.into_iter().map(Diagnostic::note);
                    let warnings = arranged.warnings.into_iter().map(Diagnostic::warning);
                    opened.diagnostics.extend(notes.chain(warnings).map(|d| d.in_file(name)));
                    opened.map = EnvironmentMap::Cubemap(arranged.cubemap);
                }
            }
        }
        self.pay(bytes, name)?;
        Ok(opened)
    }

    /// A square picture is one of six faces: the others lie beside it.
    fn open_with_siblings(&self, name: &str, path: &Path) -> Result<OpenedEnvironment, ReadError> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let names = sorted_names(files::list(self.files, folder));
        let own = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        let assignment = names::assign_with(&names, &own).map_err(|e| read_error(e, name))?;
        self.open_faces(name, folder, &names, assignment)
    }

    fn open_faces(
        &self,
        name: &str,
        folder: &Path,
        names: &[String],
        assignment: Assignment,
    ) -> Result<OpenedEnvironment, ReadError> {
        let layout = self.options.layout.unwrap_or(Layout::Photographic);
        let paths = assignment.files.map(|i| folder.join(names.get(i).map_or("", |n| n.as_str())));
        let shown = |i: usize| paths[i].display().to_string();
        // Six at once: what is left is for all.
        let limits = gonio_image::DecodeLimits { max_bytes: limits_of(self.files).max_bytes / 6 };
        let read: Vec<Result<Decoded, ReadError>> =
            (0..6_usize).into_par_iter().map(|i| self.decode(&shown(i), &paths[i], &limits)).collect();
        let mut diagnostics: Vec<Diagnostic> =
            assignment.notes.into_iter().map(|n| Diagnostic::note(n).in_file(name)).collect();
        let (mut high_dynamic_range, mut format) = (false, None);
        let mut faces: [Image; 6] = Default::default();
        for (i, decoded) in read.into_iter().enumerate() {
            let decoded = decoded?;
            self.pay(memory(&decoded), &shown(i))?;
            high_dynamic_range |= decoded.high_dynamic_range;
            format = format.or(Some(decoded.format));
            diagnostics.append(&mut diagnostics_of(&decoded, &shown(i)));
            match decoded.shape {
                DecodedContent::Picture(image) => faces[i] = image,
                DecodedContent::Faces(_) => {
                    let message = "this file holds six faces, but one face was expected; name this file alone";
                    return Err(ReadError::new(message).in_file(&shown(i)));
                }
            }
        }
        // The sentence names the face; the user knows its file.
        let named = |e: EnvironmentError| {
            let wrong = Face::ALL.into_iter().position(|f| e.message.contains(&format!("the face `{}`", f.name())));
            read_error(e, &wrong.map_or_else(|| name.to_owned(), shown))
        };
        let map = Cubemap::from_faces(faces, layout).map_err(named)?;
        Ok(OpenedEnvironment {
            name: name.to_owned(),
            map: EnvironmentMap::Cubemap(map),
            arrangement: Arrangement::Faces,
            layout: Some(layout),
            files: paths.to_vec(),
            high_dynamic_range,
            format,
            diagnostics,
        })
    }

    fn pay(&self, bytes: u64, name: &str) -> Result<(), ReadError> {
        let over = |over| ReadError::new(format!("decoded, it {over}")).caused_by(Cause::MemoryLimit).in_file(name);
        self.files.budget().spend(bytes).map_err(over)
    }

    /// Reads and decodes a picture. Its pixels are not paid for yet: a face is decoded alone to see that it is one.
    fn decode(&self, name: &str, path: &Path, limits: &gonio_image::DecodeLimits) -> Result<Decoded, ReadError> {
        let bytes = files::read(self.files, path).map_err(|e| {
            let message = match (e.kind(), nearest_builtin(name)) {
                (std::io::ErrorKind::NotFound, Some(meant)) => {
                    format!("there is no such file or folder; did you mean `{meant}`, which is built in?")
                }
                (std::io::ErrorKind::NotFound, None) => {
                    "there is no such file or folder; check the path, or use debug, sky or room to try things out"
                        .into()
                }
                // A folder with something in it is not read as a file.
                (std::io::ErrorKind::IsADirectory, _) => {
                    "the folder is empty; it must hold six faces, for example posx.png negx.png posy.png negy.png \
                     posz.png negz.png"
                        .into()
                }
                _ => return files::failed(&e).in_file(name),
            };
            ReadError::new(message).in_file(name)
        })?;
        decode(name, &bytes, limits).map_err(|e| match input_kind::is_model_or_scene(&bytes, path) {
            Some(what) if FileFormat::detect(&bytes).is_none() => {
                let message = format!("this is {what}, not a picture; to draw it, name it as the input");
                ReadError::new(message).in_file(name)
            }
            _ => read_error(e.into(), name),
        })
    }
}

/// Bytes of decoded pixels.
fn memory(decoded: &Decoded) -> u64 {
    let pixels = |image: &Image| size_of_val(image.pixels.as_slice()) as u64;
    match &decoded.shape {
        DecodedContent::Picture(image) => pixels(image),
        DecodedContent::Faces(faces) => faces.iter().map(pixels).sum(),
    }
}

fn read_error(error: EnvironmentError, name: &str) -> ReadError {
    let file = error.file.unwrap_or_else(|| name.to_owned());
    let cause = error.over_limit.then_some(Cause::MemoryLimit);
    ReadError { cause, ..ReadError::new(error.message) }.in_file(&file)
}

fn diagnostics_of(decoded: &Decoded, name: &str) -> Vec<Diagnostic> {
    let notes = decoded.notes.iter().map(|n| Diagnostic::note(n.as_str()));
    let warnings = decoded.warnings.iter().map(|w| Diagnostic::warning(w.as_str()));
    notes.chain(warnings).map(|d| d.in_file(name)).collect()
}

fn sorted_names(entries: Vec<PathBuf>) -> Vec<String> {
    let mut names: Vec<String> = entries.iter().map(|p| p.to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// Whether a name matches a pattern, in which `*` matches any letters.
fn matches(pattern: &str, name: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == name,
        Some((begin, rest)) => name.strip_prefix(begin).is_some_and(|name| {
            let starts = name.char_indices().map(|(i, _)| i).chain([name.len()]);
            starts.into_iter().any(|i| matches(rest, &name[i..]))
        }),
    }
}

/// An environment for a scene, with its warnings and notes.
pub(crate) struct ReadEnvironment {
    pub environment: LoadedEnvironment,
    /// The layout and the size that a scene file needs to be read as this again; `None` where image and background
    /// differ and each has its own default.
    pub layout: Option<Layout>,
    pub size: Option<u32>,
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads the environment of a scene.
pub(crate) fn load<S: FileSource>(
    spec: &EnvironmentSpec,
    base: &Path,
    files: &Budgeted<S>,
) -> Result<ReadEnvironment, ReadError> {
    let options = EnvironmentReadOptions { layout: spec.layout, arrangement: None, size: spec.size };
    let opened = open_within(&spec.image, options, base, files)?;
    let mut layouts: Vec<Layout> = opened.layout.into_iter().collect();
    let mut diagnostics = opened.diagnostics;
    // A wrong guess shows a mirrored world: name the layout that was assumed.
    let guessed = opened.layout.filter(|_| spec.layout.is_none() && !opened.files.is_empty());
    diagnostics.extend(guessed.map(|layout| layout_taken(layout, &opened.name)));
    let map = as_cubemap(opened.map, spec.size, &opened.name, &mut diagnostics);
    let mut size = Some(map.size());
    let mut environment = LoadedEnvironment::new(opened.name, map);
    if let Some(name) = &spec.background {
        let mut behind = open_within(name, options, base, files)?;
        layouts.extend(behind.layout);
        diagnostics.append(&mut behind.diagnostics);
        let map = as_cubemap(behind.map, spec.size, &behind.name, &mut diagnostics);
        size = size.filter(|size| *size == map.size()).or(spec.size);
        environment = environment.with_background(map);
    }
    if spec.layout.is_some() && layouts.is_empty() {
        diagnostics.push(layout_unused(&spec.image));
    }
    let layout = layouts.first().copied().filter(|first| layouts.iter().all(|l| l == first));
    Ok(ReadEnvironment { environment, layout, size, diagnostics })
}

/// Names the layout that was assumed.
fn layout_taken(layout: Layout, name: &str) -> Diagnostic {
    let other = if layout == Layout::OpenGl { Layout::Photographic } else { Layout::OpenGl };
    let message =
        format!("the faces are read in the layout `{layout}`; if the world looks mirrored, set the layout `{other}`");
    Diagnostic::note(message).caused_by(Cause::GuessedLayout).in_file(name)
}

/// Converts to a cubemap of `size`, or of the size that suits the map.
fn as_cubemap(source: EnvironmentMap, size: Option<u32>, name: &str, diagnostics: &mut Vec<Diagnostic>) -> Cubemap {
    let natural = source.as_environment().natural_cubemap_size();
    let usual = match &source {
        EnvironmentMap::Cubemap(_) => natural,
        EnvironmentMap::Panorama(_) => natural.min(USUAL_SIZE_MAX),
    };
    let size = size.unwrap_or(usual);
    if usual < natural && size < natural {
        let message = format!(
            "the panorama has the resolution of a cubemap of {natural} texels along an edge, and is converted to one of \
             {size}; to keep more, set a larger size"
        );
        diagnostics.push(Diagnostic::note(message).caused_by(Cause::CoarseEnvironment).in_file(name));
    }
    match source {
        EnvironmentMap::Cubemap(map) if map.size() == size => map,
        other => Conversion::default().cubemap(other.as_environment(), size),
    }
}
