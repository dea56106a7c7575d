//! Which files a `render` will write, settled before anything is drawn.

use crate::output::atomic;
use crate::report::{CliError, Reporter};
use crate::values::nearest;
use gonio_scene::ViewSpec;
use std::path::{Path, PathBuf};

/// A picture file's format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// 8 or 16 bits, encoded.
    Png,
    /// Animated PNG.
    Apng,
    /// 256 colours a frame.
    Gif,
    /// 32-bit float, linear.
    Exr,
}

impl Format {
    /// All.
    pub const ALL: &'static [Self] = &[Self::Png, Self::Apng, Self::Gif, Self::Exr];

    /// As written: the extension.
    pub fn name(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Apng => "apng",
            Self::Gif => "gif",
            Self::Exr => "exr",
        }
    }

    /// By the extension of a file's name.
    fn of_path(path: &Path) -> Result<Format, CliError> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
        if let Some(known) = Self::ALL.iter().find(|f| f.name() == extension) {
            return Ok(*known);
        }
        let what = match extension.as_str() {
            "" => "has no extension that says what to write".to_owned(),
            other => format!("`.{other}` is not written"),
        };
        let nearest = nearest(&extension, Self::ALL.iter().map(|f| f.name()));
        let hint = nearest.map(|k| format!("; did you mean .{k}?")).unwrap_or_default();
        Err(CliError::new(format!(
            "`{}`: {what}; gonio writes .png (8 or 16 bits), .exr (linear float), .apng and .gif (animations){hint}",
            path.display()
        )))
    }

    /// Whether all frames go into one file.
    pub fn is_animation(self) -> bool {
        matches!(self, Format::Apng | Format::Gif)
    }
}

/// Where the bytes go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// `-`
    Stdout,
    /// A file, or (numbered) the pattern of several.
    File(PathBuf),
}

/// One `-o` with its format.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Where to.
    pub target: Target,
    /// What.
    pub format: Format,
    /// How many frames there will be, 1 without `--frames`.
    pub frames: u32,
    /// Bits a channel of PNG.
    pub bits: u8,
}

/// What the plan depends on.
pub struct PlanRequest<'a> {
    /// `-o`, each.
    pub outputs: &'a [String],
    /// `--format`, for stdout.
    pub format: Option<Format>,
    /// `--frames`
    pub frames: Option<u32>,
    /// `--animated`
    pub animated: bool,
    /// `--views`
    pub views: &'a [ViewSpec],
    /// `--bits`
    pub bits: Option<u8>,
}

impl PlanRequest<'_> {
    /// Settles every file, and whether it can be written.
    pub fn plan(&self, reporter: &Reporter) -> Result<Vec<Plan>, CliError> {
        let plans: Vec<Plan> =
            self.outputs.iter().map(|output| self.plan_one(output, reporter)).collect::<Result<_, _>>()?;
        if plans.iter().filter(|p| p.target == Target::Stdout).count() > 1 {
            return Err(CliError::new("`-o -` is given twice; stdout takes one picture"));
        }
        if self.bits.is_some() && !plans.iter().any(|p| p.format == Format::Png) {
            return Err(CliError::new("--bits belongs to .png; .exr always has 32-bit floats, animations 8 bits"));
        }
        for plan in &plans {
            for path in plan.all_paths(self.views) {
                atomic::check_writable(&path)?;
            }
        }
        Ok(plans)
    }

    fn plan_one(&self, output: &str, reporter: &Reporter) -> Result<Plan, CliError> {
        let (target, mut format) = if output == "-" {
            if reporter.json() {
                return Err(CliError::new(
                    "`-o -` and --json would both go to stdout; write the picture to a file, or leave --json out",
                ));
            }
            if reporter.stdout_is_terminal() {
                return Err(CliError::new(
                    "`-o -` would write the picture to a terminal; redirect stdout, or give a file's name",
                ));
            }
            (Target::Stdout, self.format.unwrap_or(Format::Png))
        } else {
            let path = PathBuf::from(output);
            let format = match self.format {
                // A device has no extension.
                Some(format) => format,
                None => Format::of_path(&path)?,
            };
            (Target::File(path), format)
        };
        if self.animated && format == Format::Png {
            format = Format::Apng;
        }
        if self.animated && format == Format::Exr {
            return Err(CliError::new("--animated belongs to .png; .exr holds no animations"));
        }
        let frames = self.frames.unwrap_or(1);
        if target == Target::Stdout && self.frames.is_some() && !format.is_animation() {
            return Err(CliError::new("stdout takes one file; for several frames add --format gif or --format apng"));
        }
        if !self.views.is_empty() && format.is_animation() {
            return Err(CliError::new(
                "an animation holds one view; choose it with --debug, or write numbered .png or .exr files",
            ));
        }
        if !self.views.is_empty() && target == Target::Stdout && format == Format::Png {
            return Err(CliError::new("stdout takes one file; for --views on stdout add --format exr (layers)"));
        }
        Ok(Plan { target, format, frames, bits: self.bits.unwrap_or(8) })
    }
}

impl Plan {
    /// The file of frame `frame` (from 0), and of `view` where views have files of their own.
    pub fn path(&self, frame: u32, view: Option<ViewSpec>) -> Option<PathBuf> {
        let Target::File(path) = &self.target else { return None };
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
        let has_pattern = matches!(&self.target, Target::File(p) if pattern(&p.to_string_lossy()).is_some());
        !self.format.is_animation() && (self.frames > 1 || has_pattern)
    }

    fn all_paths(&self, views: &[ViewSpec]) -> Vec<PathBuf> {
        let own_views: &[ViewSpec] = if self.format == Format::Png { views } else { &[] };
        // The frames stand in one folder: the first and the last tell whether it can be written.
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

/// The place of `%d` or `%0Nd` in a name, and N.
fn pattern(name: &str) -> Option<(std::ops::Range<usize>, usize)> {
    let start = name.find('%')?;
    let rest = &name[start + 1..];
    let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
    let width = if digits == 0 { 0 } else { rest[..digits].parse().ok().filter(|w| *w <= 16)? };
    rest[digits..].starts_with('d').then_some((start..start + digits + 2, width))
}

/// `out.png` to `out-0001.png`, `out%02d.png` to `out01.png`.
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

    fn plan(path: &str, format: Format, frames: u32) -> Plan {
        Plan { target: Target::File(path.into()), format, frames, bits: 8 }
    }

    #[test]
    fn names_of_frames_and_views() {
        let view = Some("diffuse:2".parse::<ViewSpec>().unwrap());
        let name = |plan: &Plan, frame, view| plan.path(frame, view).unwrap().to_string_lossy().into_owned();
        assert_eq!(name(&plan("d/out.png", Format::Png, 1), 0, None), "d/out.png");
        assert_eq!(name(&plan("d/out.png", Format::Png, 1), 0, view), "d/out-diffuse-2.png");
        assert_eq!(name(&plan("d/out.png", Format::Png, 9), 8, None), "d/out-0009.png");
        assert_eq!(name(&plan("d/out.png", Format::Png, 9), 8, view), "d/out-0009-diffuse-2.png");
        assert_eq!(name(&plan("a%03d.exr", Format::Exr, 9), 0, None), "a001.exr");
        assert_eq!(name(&plan("a%d.exr", Format::Exr, 9), 11, None), "a12.exr");
        assert_eq!(name(&plan("out.gif", Format::Gif, 9), 8, None), "out.gif");
        // A percent sign that is no pattern is a percent sign.
        assert_eq!(name(&plan("50%.png", Format::Png, 9), 0, None), "50%-0001.png");
        assert_eq!(name(&plan("%99d.png", Format::Png, 9), 0, None), "%99d-0001.png");
    }

    #[test]
    fn an_unknown_extension_is_told_what_can_be_written() {
        let text = Format::of_path(Path::new("a.jpg")).unwrap_err().to_string();
        assert!(text.contains("`.jpg` is not written") && text.contains(".exr (linear float)"), "{text}");
        let text = Format::of_path(Path::new("a.pgn")).unwrap_err().to_string();
        assert!(text.contains("did you mean .png?"), "{text}");
        assert!(Format::of_path(Path::new("a")).unwrap_err().to_string().contains("no extension"));
        assert_eq!(Format::of_path(Path::new("A.PNG")).unwrap(), Format::Png);
    }
}
