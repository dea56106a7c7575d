//! The files that `render` will write, settled before anything is drawn.

use crate::error::CliError;
use crate::output::{OutputKind, OutputPath, atomic, check_stdout};
use crate::report::Reporter;
use gonio_scene::{ViewSpec, nearest_word};
use std::path::{Path, PathBuf};

/// A picture file's format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// 8 or 16 bits, encoded.
    Png,
    /// Animated PNG.
    Apng,
    /// 256 colours per frame.
    Gif,
    /// 32-bit float, linear.
    Exr,
}

impl PictureFormat {
    pub const ALL: &'static [Self] = &[Self::Png, Self::Apng, Self::Gif, Self::Exr];

    /// The extension.
    pub fn name(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Apng => "apng",
            Self::Gif => "gif",
            Self::Exr => "exr",
        }
    }

    /// Finds the format by the extension of a file's name.
    fn from_path(path: &Path) -> Result<PictureFormat, CliError> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
        if let Some(known) = Self::ALL.iter().find(|f| f.name() == extension) {
            return Ok(*known);
        }
        let fault = match extension.as_str() {
            "" => "the name has no extension to choose the format by".to_owned(),
            other => format!("unsupported format `.{other}`"),
        };
        let nearest = nearest_word(&extension, Self::ALL.iter().map(|f| f.name()));
        let hint = nearest.map(|k| format!("; did you mean .{k}?")).unwrap_or_default();
        Err(CliError::new(format!(
            "`{}`: {fault}: expected .png (8 or 16 bits), .exr (linear float), .apng or .gif (animations){hint}",
            path.display()
        )))
    }

    /// Whether all frames go into one file.
    pub fn is_animation(self) -> bool {
        matches!(self, PictureFormat::Apng | PictureFormat::Gif)
    }
}

/// One `-o` with its format.
#[derive(Clone, Debug)]
pub struct PicturePlan {
    /// Stdout, a file, or the pattern of several numbered ones.
    pub output: OutputPath,
    pub format: PictureFormat,
    /// The number of frames, 1 without `--frames`.
    pub frames: u32,
    /// Bits per channel of PNG.
    pub bits: u8,
}

/// The options that determine the plans.
pub struct PicturePlanRequest<'a> {
    /// Every `-o`.
    pub outputs: &'a [OutputPath],
    /// `--format`, for stdout.
    pub format: Option<PictureFormat>,
    pub frames: Option<u32>,
    pub animated: bool,
    pub views: &'a [ViewSpec],
    pub bits: Option<u8>,
}

impl PicturePlanRequest<'_> {
    /// Settles every file, and checks that it can be written.
    pub fn plan(&self, reporter: &Reporter) -> Result<Vec<PicturePlan>, CliError> {
        check_stdout(self.outputs.iter().map(|output| (output, OutputKind::Binary)), reporter)?;
        let plans: Vec<PicturePlan> =
            self.outputs.iter().map(|output| self.plan_one(output)).collect::<Result<_, _>>()?;
        if self.bits.is_some() && !plans.iter().any(|p| p.format == PictureFormat::Png) {
            return Err(CliError::new(
                "--bits applies to .png only; .exr always has 32-bit floats, animations have 8 bits",
            ));
        }
        for plan in &plans {
            for path in plan.all_paths(self.views) {
                atomic::check_writable(&path)?;
            }
        }
        Ok(plans)
    }

    fn plan_one(&self, output: &OutputPath) -> Result<PicturePlan, CliError> {
        let mut format = match (self.format, output) {
            // A device has no extension.
            (Some(format), _) => format,
            (None, OutputPath::File(path)) => PictureFormat::from_path(path)?,
            (None, OutputPath::Stdout) => PictureFormat::Png,
        };
        if self.animated && format == PictureFormat::Png {
            format = PictureFormat::Apng;
        }
        if self.animated && format == PictureFormat::Exr {
            return Err(CliError::new("--animated applies to .png only; .exr has no animations"));
        }
        let frames = self.frames.unwrap_or(1);
        if output.is_stdout() && self.frames.is_some() && !format.is_animation() {
            return Err(CliError::new(
                "stdout takes one file; --format gif or --format apng puts several frames into one",
            ));
        }
        if !self.views.is_empty() && format.is_animation() {
            return Err(CliError::new(
                "an animation shows one view: choose it with --debug, or write numbered .png or .exr files",
            ));
        }
        if !self.views.is_empty() && output.is_stdout() && format == PictureFormat::Png {
            return Err(CliError::new("stdout takes one file; --format exr puts several views into one, as layers"));
        }
        Ok(PicturePlan { output: output.clone(), format, frames, bits: self.bits.unwrap_or(8) })
    }
}

impl PicturePlan {
    /// The output of frame `frame` (from 0), and of `view` if views have files of their own.
    pub fn output(&self, frame: u32, view: Option<ViewSpec>) -> OutputPath {
        self.path(frame, view).map_or(OutputPath::Stdout, OutputPath::File)
    }

    fn path(&self, frame: u32, view: Option<ViewSpec>) -> Option<PathBuf> {
        let path = self.output.file()?;
        let mut name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if self.is_numbered() {
            name = numbered(&name, frame + 1);
        }
        if let Some(view) = view {
            let (stem, extension) = split_extension(&name);
            name = format!("{stem}-{}{extension}", view.to_string().replace(':', "-"));
        }
        Some(path.with_file_name(name))
    }

    /// Whether each frame has a file of its own.
    fn is_numbered(&self) -> bool {
        let has_pattern = self.output.file().is_some_and(|path| pattern(&path.to_string_lossy()).is_some());
        !self.format.is_animation() && (self.frames > 1 || has_pattern)
    }

    fn all_paths(&self, views: &[ViewSpec]) -> Vec<PathBuf> {
        let own_views: &[ViewSpec] = if self.format == PictureFormat::Png { views } else { &[] };
        // All frames are in one folder: checking the first and the last is enough.
        let frames = if self.is_numbered() { [0, self.frames - 1] } else { [0, 0] };
        let mut paths: Vec<PathBuf> = frames
            .into_iter()
            .flat_map(|f| std::iter::once(None).chain(own_views.iter().copied().map(Some)).map(move |v| (f, v)))
            .filter_map(|(f, v)| self.path(f, v))
            .collect();
        paths.dedup();
        paths
    }
}

/// The position of `%d` or `%0Nd` in a name, and N.
fn pattern(name: &str) -> Option<(std::ops::Range<usize>, usize)> {
    let start = name.find('%')?;
    let rest = &name[start + 1..];
    let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
    let width = if digits == 0 { 0 } else { rest[..digits].parse().ok().filter(|w| *w <= 16)? };
    rest[digits..].starts_with('d').then_some((start..start + digits + 2, width))
}

/// A numbered name: `out-0001.png` for `out.png`, `out01.png` for `out%02d.png`.
fn numbered(name: &str, number: u32) -> String {
    match pattern(name) {
        Some((range, width)) => format!("{}{number:0width$}{}", &name[..range.start], &name[range.end..]),
        None => {
            let (stem, extension) = split_extension(name);
            format!("{stem}-{number:04}{extension}")
        }
    }
}

fn split_extension(name: &str) -> (&str, &str) {
    name.rfind('.').filter(|&dot| dot > 0).map_or((name, ""), |dot| name.split_at(dot))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn plan(path: &str, format: PictureFormat, frames: u32) -> PicturePlan {
        PicturePlan { output: OutputPath::File(path.into()), format, frames, bits: 8 }
    }

    #[test]
    fn names_of_frames_and_views() {
        let view = Some("diffuse:2".parse::<ViewSpec>().unwrap());
        let name = |plan: &PicturePlan, frame, view| plan.path(frame, view).unwrap().to_string_lossy().into_owned();
        assert_eq!(name(&plan("d/out.png", PictureFormat::Png, 1), 0, None), "d/out.png");
        assert_eq!(name(&plan("d/out.png", PictureFormat::Png, 1), 0, view), "d/out-diffuse-2.png");
        assert_eq!(name(&plan("d/out.png", PictureFormat::Png, 9), 8, None), "d/out-0009.png");
        assert_eq!(name(&plan("d/out.png", PictureFormat::Png, 9), 8, view), "d/out-0009-diffuse-2.png");
        assert_eq!(name(&plan("a%03d.exr", PictureFormat::Exr, 9), 0, None), "a001.exr");
        assert_eq!(name(&plan("a%d.exr", PictureFormat::Exr, 9), 11, None), "a12.exr");
        assert_eq!(name(&plan("out.gif", PictureFormat::Gif, 9), 8, None), "out.gif");
        // A percent sign outside a pattern is a percent sign.
        assert_eq!(name(&plan("50%.png", PictureFormat::Png, 9), 0, None), "50%-0001.png");
        assert_eq!(name(&plan("%99d.png", PictureFormat::Png, 9), 0, None), "%99d-0001.png");
    }

    #[test]
    fn an_unknown_extension_gets_a_list_of_the_known_ones() {
        let text = PictureFormat::from_path(Path::new("a.jpg")).unwrap_err().to_string();
        assert!(text.contains("unsupported format `.jpg`") && text.contains(".exr (linear float)"), "{text}");
        let text = PictureFormat::from_path(Path::new("a.pgn")).unwrap_err().to_string();
        assert!(text.contains("did you mean .png?"), "{text}");
        assert!(PictureFormat::from_path(Path::new("a")).unwrap_err().to_string().contains("no extension"));
        assert_eq!(PictureFormat::from_path(Path::new("A.PNG")).unwrap(), PictureFormat::Png);
    }
}
