//! The web page of a staircase, one slide per step, and the files of its pictures. The page holds everything that it shows.

use crate::comparison::light;
use crate::report::{CubemapReport, PictureReport, StaircaseReport, StepReport, heading, percent};
use crate::staircase::{Staircase, TracedPicture};
use glam::DVec3;
use gonio_gallery::markup::{escape, html, mathml};
use gonio_gallery::page::STYLE;
use gonio_image::encode::exr::{self, Layer};
use gonio_image::encode::png::{self, ColorTag};
use gonio_image::{EncodedPicture, ImageError};
use gonio_light::color::ColorEncoding;
use gonio_scene::difference::heat;
use gonio_scene::{DisplayMap, Frame, Picture};
use gonio_trace::Simplification;

/// FLIP in the brightest colour of a map.
const FULL_SCALE: f64 = 0.8;

const OWN_STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// A file of the folder: its path in it, and its bytes.
pub type PageFile = (String, Vec<u8>);

/// All files of the folder but the report, the page last. `command` is what made it, `subject` the name of the scene.
///
/// # Errors
///
/// A picture that cannot be encoded.
pub fn files(
    staircase: &Staircase,
    report: &StaircaseReport,
    frame: &Frame,
    subject: &str,
    command: &str,
) -> Result<Vec<PageFile>, ImageError> {
    let mut pictures = Pictures { frame, files: Vec::new() };
    let truth = pictures.add_traced("0-truth", &staircase.truth)?;
    let truth_caption = caption("The truth", &staircase.truth);
    let mut slides = format!(
        "<section class=\"slide first\" id=\"truth\" data-title=\"The rendering equation\">\n<h2><b>0</b>The rendering equation</h2>\n\
         <p>Light comes from everywhere: it is added up over all directions, at every wavelength and moment. What comes in is what \
         another surface sends out, so this is a recursive call. This picture solves it by following the paths of light.</p>\n\
         <div class=\"formulas\">{}\n<div class=\"formula where\">{}</div></div>\n\
         <div class=\"pictures one\"><figure>{truth}<figcaption>{truth_caption}</figcaption></figure></div>\n<dl>{}</dl>\n</section>\n",
        equation(&report.truth_formula),
        mathml("L_i(x, ω_i, λ, t) = L_o(x', −ω_i, λ, t)"),
        numbers(&report.truth),
    );
    let mut id_before = "truth";
    for (step, drawn) in report.steps.iter().zip(&staircase.steps) {
        let name = format!("{}-{}", step.number, step.name);
        let picture = pictures.add_traced(&name, &drawn.traced)?;
        let ring = drawn.to_before.most.as_ref().map_or_else(String::new, |most| {
            let share = |at: u32, side: u32| 100.0 * f64::from(at) / f64::from(side.max(1));
            let (left, top) = (share(most.x, frame.width), share(most.y, frame.height));
            format!("<i class=\"ring\" style=\"left: {left:.1}%; top: {top:.1}%\"></i>")
        });
        let picture = format!("<div class=\"shown\" data-before=\"{id_before}\">{picture}{ring}</div>");
        id_before = step.name;
        let before = pictures.add_map(&format!("{name}-from-before"), &drawn.to_before.map)?;
        let truth = pictures.add_map(&format!("{name}-from-truth"), &drawn.to_truth.map)?;
        let caption = caption(step.title, &drawn.traced);
        slides += &slide(step, drawn.step, &caption, !ring.is_empty(), [picture, before, truth]);
    }
    if let Some(drawn) = &staircase.light_equation {
        let picture = pictures.add("light-equation", &drawn.picture)?;
        let map = pictures.add_map("light-equation-from-last-step", &drawn.map)?;
        slides += &format!(
            "<section class=\"slide\" id=\"light-equation\" data-title=\"The light equation\">\n<h2><b>=</b>The light equation</h2>\n\
             <p>The same lights, without a single path: this is what <code>gonio render</code> draws, and OpenGL.</p>\n\
             <div class=\"formulas\">{}</div>\n<div class=\"pictures two\">\n\
             <figure>{picture}<figcaption>By the light equation, in {}</figcaption></figure>\n\
             <figure>{map}<figcaption>What differs from the last step: FLIP {:.4}</figcaption></figure></div>\n\
             <p class=\"look\">{}</p>\n</section>\n",
            equation(&report.steps.last().map_or_else(String::new, |s| s.result.clone())),
            seconds(drawn.seconds),
            drawn.flip,
            inline(&price(report, drawn.seconds)),
        );
    }
    if let Some(fit) = &staircase.ambient {
        let picture = pictures.add("fitted-ambient", &fit.picture)?;
        slides += &format!(
            "<section class=\"slide\" id=\"ambient-fit\" data-title=\"The A that loses least\">\n<h2><b>A</b>The A that loses least</h2>\n\
             <p>Step 8 and the best constant: of all colours of A, this one comes nearest to the truth on the objects, by least \
             squares.</p>\n<div class=\"formulas\"><div class=\"formula\">{}</div></div>\n<div class=\"pictures two\">\n\
             <figure>{picture}<figcaption>With the fitted A</figcaption></figure>\n<figure>{truth}<figcaption>{truth_caption}</figcaption>\
             </figure></div>\n<table><tr><th>ambient light</th><th>A (linear RGB)</th><th>RMS that remains on the objects</th></tr>\n\
             {}{}{}</table>\n</section>\n",
            mathml("min_A Σ_x (L_{truth}(x) − L_8(x) − k_a(x) A)^2"),
            ambient_row("none", DVec3::ZERO, fit.rms_without),
            ambient_row("the scene's own", fit.own, fit.rms_own),
            ambient_row("fitted", fit.color, fit.rms_fitted),
        );
    }
    if let (Some(drawn), Some(cubemap)) = (&staircase.cubemap, &report.cubemap) {
        let picture = pictures.add("cubemap", &drawn.picture)?;
        let map = pictures.add_map("cubemap-from-truth", &drawn.map)?;
        slides += &cubemap_slide(cubemap, &truth_caption, [truth, picture, map]);
    }
    slides += &tables(report);
    let page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>gonio: {subject}, simplified</title>\n\
         <style>\n{STYLE}{OWN_STYLE}:root {{ --aspect: {aspect:.3}; }}\n.scale {{ background: linear-gradient(to right, {colors}); }}\n</style>\n</head>\n<body>\n<header>\n<h1>gonio</h1>\n\
         <p>From the rendering equation to the light equation, in {subject}: what each simplification gives up here, and what it \
         saves.</p>\n</header>\n<main>\n{slides}</main>\n\
         <div id=\"bar\"><button aria-label=\"previous\">‹</button><input type=\"range\" min=\"0\" step=\"1\" aria-label=\"step\">\
         <button aria-label=\"next\">›</button><output></output><button>all slides</button></div>\n\
         <footer>Made by <code>{}</code>, gonio {}. All pictures are traced with the same random numbers. Differences are \
         FLIP (Andersson et al. 2020), from black, equal, to white, {FULL_SCALE} or more. RMS and noise are of linear light, relative \
         to the mean luminance of the truth.{left_out} {denoised}Times are computing times of this machine; at equal error: until \
         the error of a pixel is 1 %.</footer>\n<script>{SCRIPT}</script>\n</body>\n</html>\n",
        escape(&visible(command)),
        env!("CARGO_PKG_VERSION"),
        aspect = f64::from(frame.width) / f64::from(frame.height.max(1)),
        colors = (0..=8).map(|i| hex(heat(f64::from(i) / 8.0))).collect::<Vec<_>>().join(", "),
        left_out = left_out(report.left_out),
        denoised = if staircase.truth.denoised.is_some() { DENOISED_NOTE } else { "" },
        subject = escape(&visible(subject)),
    );
    pictures.files.push(("index.html".to_owned(), page.into_bytes()));
    Ok(pictures.files)
}

/// What the footer says about pictures without noise.
const DENOISED_NOTE: &str = "Pictures and maps are shown without most of their noise, which a filter removed that may be wrong; all \
                             numbers, FLIP too, are those of the traced pictures, which the .exr files hold. ";

/// What the footer says about pixels that do not count.
fn left_out(share: f64) -> String {
    if share <= 0.0 {
        return String::new();
    }
    format!(
        " They, and mean radiances, leave out the {} of the pixels in which a lamp brighter than white is seen; FLIP counts them.",
        percent(share)
    )
}

/// The caption of a traced picture: what was done to it is never silent.
fn caption(title: &str, traced: &TracedPicture) -> String {
    let filtered = if traced.denoised.is_some() { ", denoised" } else { "" };
    format!("{}: {} paths per pixel{filtered}", escape(title), traced.paths())
}

/// An equation, which may be broken before its integral or its sum.
fn equation(markup: &str) -> String {
    // Two symbols, not one word.
    let markup = &markup.replace("dω_i", "d{ω}_i");
    let mut parts = vec![markup.as_str()];
    if let Some(at) = markup.find(['∫', 'Σ']) {
        let at = if markup[..at].ends_with("-{") || markup[..at].ends_with("!{") { at - 2 } else { at };
        let (first, second) = markup.split_at(at);
        if first.matches('{').count() == first.matches('}').count() {
            parts = vec![first, second];
        }
    }
    let parts: String = parts.into_iter().map(mathml).collect();
    format!("<div class=\"formula\">{parts}</div>")
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn slide(
    step: &StepReport,
    simplification: Simplification,
    caption: &str,
    has_ring: bool,
    [picture, before, truth]: [String; 3],
) -> String {
    let (_, _, lecture) = heading(simplification);
    let ring = if has_ring { " <i class=\"ring key\"></i> changes most." } else { "" };
    format!(
        "<section class=\"slide\" id=\"{name}\" data-title=\"{number} {title}\">\n<h2><b>{number}</b>{title}</h2>\n<p>{lecture}</p>\n\
         <div class=\"formulas\">{struck}\n{result}</div>\n\
         <div class=\"pictures\">\n<figure>{picture}<figcaption>{caption}.{ring}<span class=\"hint\"> Hold the picture to see the \
         step before.</span></figcaption></figure>\n\
         <figure>{before}<figcaption>What this step changes: FLIP {flip_before:.3}</figcaption></figure>\n\
         <figure>{truth}<figcaption>What differs from the truth by now: FLIP {flip_truth:.3}<span class=\"legend\">0<span \
         class=\"scale\"></span>{FULL_SCALE}</span></figcaption></figure></div>\n\
         <p class=\"look\">{look}</p>\n<dl>{numbers}<dt>RMS to the step before</dt><dd>{rms} (noise: {noise})</dd>\
         <dt>RMS to the truth</dt><dd>{rms_truth} (noise: {noise_truth})</dd></dl>\n</section>\n",
        name = step.name,
        number = step.number,
        title = escape(step.title),
        lecture = html(lecture),
        struck = equation(&step.struck),
        result = equation(&step.result),
        flip_before = step.to_before.flip,
        flip_truth = step.to_truth.flip,
        look = inline(&step.look),
        numbers = numbers(&step.picture),
        rms = percent(step.to_before.rms),
        noise = percent(step.to_before.noise),
        rms_truth = percent(step.to_truth.rms),
        noise_truth = percent(step.to_truth.noise),
    )
}

fn cubemap_slide(cubemap: &CubemapReport, truth_caption: &str, [truth, picture, map]: [String; 3]) -> String {
    let brighter = |share: Option<f64>| share.map_or_else(|| "–".to_owned(), signed_percent);
    let rows: String = cubemap
        .objects
        .iter()
        .map(|o| {
            format!(
                "<tr><td>{}</td><td>{:.3}</td><td>{}</td><td style=\"white-space: normal; text-align: left\">{}</td></tr>\n",
                escape(&visible(&o.name)),
                o.flip,
                brighter(o.brighter),
                escape(&o.reason)
            )
        })
        .collect();
    format!(
        "<section class=\"slide\" id=\"cubemap\" data-title=\"With a cubemap\">\n<h2><b>?</b>Is this image achievable with OpenGL? \
         Yes: with a cubemap</h2>\n<p>Mirrors and glass look up the environment where their rays of sight go. The cubemap has no \
         object in it, and there are no shadows.</p>\n<div class=\"pictures two\">\n<figure>{picture}<figcaption>The light equation with \
         the cubemap, in {}</figcaption></figure>\n<figure>{truth}<figcaption>{truth_caption}</figcaption></figure>\n<figure>{map}\
         <figcaption>What differs: FLIP {:.4}</figcaption></figure></div>\n<table><tr><th>object</th><th>FLIP on it</th><th>brighter \
         than the truth</th><th>why</th></tr>\n{rows}</table>\n</section>\n",
        seconds(cubemap.picture.seconds),
        cubemap.picture.flip,
    )
}

fn numbers(picture: &PictureReport) -> String {
    let equal = picture.seconds_at_one_percent.map_or_else(|| "unknown: too few paths".to_owned(), seconds);
    let error = picture.error.map_or_else(|| "unknown".to_owned(), percent);
    let missed = if picture.missed { ", more than requested" } else { "" };
    format!(
        "<dt>mean radiance</dt><dd>{:.4}</dd><dt>computing time</dt><dd>{} for {} paths per pixel, error {error}{missed}</dd>\
         <dt>at an error of 1 %</dt><dd>{equal}</dd>",
        picture.mean,
        seconds(picture.seconds),
        picture.paths,
    )
}

/// What the light equation saves.
fn price(report: &StaircaseReport, seconds_drawn: f64) -> String {
    let distance = report.steps.last().map_or(0.0, |last| last.to_truth.flip);
    let drawn = seconds(seconds_drawn);
    match report.truth.seconds_at_one_percent.filter(|_| seconds_drawn > 0.0) {
        Some(truth) => format!(
            "The truth with an error of 1 % takes {}; this takes {drawn}, {} times less, and is {distance:.3} (FLIP) away from it.",
            seconds(truth),
            rounded(truth / seconds_drawn)
        ),
        None => format!("This takes {drawn}, and is {distance:.3} (FLIP) away from the truth."),
    }
}

fn tables(report: &StaircaseReport) -> String {
    let head = |first: &str| {
        format!(
            "<tr><th>{first}</th><th>mean radiance</th><th>RMS to the truth</th><th>of it noise</th><th>FLIP to the truth</th>\
             <th>light</th><th>time at 1 % error</th></tr>\n"
        )
    };
    let row = |step: &StepReport| {
        let c = &step.to_truth;
        format!(
            "<tr><td>{} {}</td><td>{:.4}</td><td>{}</td><td>{}</td><td>{:.4}</td><td>{}</td><td>{}</td></tr>\n",
            step.number,
            escape(step.title),
            step.picture.mean,
            percent(c.rms),
            percent(c.noise),
            c.flip,
            if c.below_noise {
                "below the noise".to_owned()
            } else {
                c.brighter.map_or_else(String::new, signed_percent)
            },
            step.picture.seconds_at_one_percent.map_or_else(|| "–".to_owned(), seconds),
        )
    };
    let mut page = format!(
        "<section class=\"slide\" id=\"all\" data-title=\"All steps\">\n<h2>All steps</h2>\n<p>Each with all steps before it.</p>\n\
         <table>{}<tr><td>0 The rendering equation</td><td>{:.4}</td><td></td><td></td><td></td><td></td><td>{}</td></tr>\n{}</table>\n",
        head("step"),
        report.truth.mean,
        report.truth.seconds_at_one_percent.map_or_else(|| "–".to_owned(), seconds),
        report.steps.iter().map(row).collect::<String>(),
    );
    if !report.alone.is_empty() {
        page += &format!(
            "<p>Each simplification alone: the truth with nothing else left out.</p>\n<table>{}{}</table>\n",
            head("only"),
            report.alone.iter().map(row).collect::<String>()
        );
    }
    page + "</section>\n"
}

fn ambient_row(name: &str, color: DVec3, rms: f64) -> String {
    let [r, g, b] = color.to_array();
    format!("<tr><td>{name}</td><td>{r:.4}, {g:.4}, {b:.4}</td><td>{}</td></tr>\n", percent(rms))
}

fn signed_percent(share: f64) -> String {
    if share.abs() < 5e-4 {
        return "0 %".to_owned();
    }
    format!("{}{}", if share > 0.0 { "+" } else { "−" }, percent(share.abs()))
}

fn seconds(s: f64) -> String {
    if s < 0.1 {
        format!("{:.1} ms", 1e3 * s)
    } else if s < 10.0 {
        format!("{s:.1} s")
    } else if s < 120.0 {
        format!("{s:.0} s")
    } else if s < 7200.0 {
        format!("{:.0} min", s / 60.0)
    } else {
        format!("{} h", rounded(s / 3600.0))
    }
}

/// Two significant digits.
fn rounded(value: f64) -> String {
    if value < 9.5 {
        return format!("{value:.1}");
    }
    let unit = 10.0_f64.powi(value.log10().floor() as i32 - 1);
    format!("{:.0}", (value / unit).round() * unit)
}

/// Text of this program with names in backticks, for the page. Colours, `#rrggbb`, are shown.
fn inline(text: &str) -> String {
    let mut escaped = String::new();
    let text = escape(&visible(text));
    let mut parts = text.split('#');
    escaped += parts.next().unwrap_or_default();
    for part in parts {
        match part.get(..6).filter(|color| color.bytes().all(|b| b.is_ascii_hexdigit())) {
            Some(color) => {
                escaped += &format!("<i class=\"swatch\" title=\"#{color}\" style=\"background: #{color}\"></i>");
                escaped += &part[6..];
            }
            None => escaped = escaped + "#" + part,
        }
    }
    let parts = escaped.split('`').enumerate();
    parts.map(|(i, part)| if i % 2 == 1 { format!("<b>{part}</b>") } else { part.to_owned() }).collect()
}

/// Control characters, and those that change the direction of text, as escapes.
fn visible(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            c if c.is_control() || ('\u{2028}'..='\u{202e}').contains(&c) || ('\u{2066}'..='\u{2069}').contains(&c) => {
                format!("\\x{:x}", u32::from(c))
            }
            c => c.to_string(),
        })
        .collect()
}

/// The files of pictures, and `<img>` elements that hold them.
struct Pictures<'a> {
    frame: &'a Frame,
    files: Vec<PageFile>,
}

impl Pictures<'_> {
    /// Adds a picture as PNG and OpenEXR.
    fn add(&mut self, name: &str, picture: &Picture) -> Result<String, ImageError> {
        let map = DisplayMap::for_view(None, self.frame);
        let size = [picture.width, picture.height];
        let layer = Layer { name: "picture", pixels: &picture.pixels };
        self.files.push((format!("{name}.exr"), exr::encode_layers(size, &[layer])?));
        Ok(self.add_png(name, png::encode8(&picture.encode8(&map), tag_of(&map))?, &mean_text(picture)))
    }

    /// Adds a traced picture: as PNG without its noise, if it has such a picture, and as OpenEXR as it was traced.
    fn add_traced(&mut self, name: &str, traced: &TracedPicture) -> Result<String, ImageError> {
        let Some(denoised) = &traced.denoised else { return self.add(name, &traced.picture) };
        let map = DisplayMap::for_view(None, self.frame);
        let size = [denoised.width, denoised.height];
        let layers = [
            Layer { name: "picture", pixels: &traced.picture.pixels },
            Layer { name: "denoised", pixels: &denoised.pixels },
        ];
        self.files.push((format!("{name}.exr"), exr::encode_layers(size, &layers)?));
        let bytes = png::encode8_with_comment(&denoised.encode8(&map), tag_of(&map), DENOISED)?;
        Ok(self.add_png(name, bytes, &mean_text(&traced.picture)))
    }

    /// Adds a map of FLIP values.
    fn add_map(&mut self, name: &str, map: &[f32]) -> Result<String, ImageError> {
        let color = |&v: &f32| {
            let [r, g, b] = heat(f64::from(v) / FULL_SCALE);
            [r, g, b, u8::MAX]
        };
        let (width, height) = (self.frame.width, self.frame.height);
        let picture = EncodedPicture { width, height, rgba: map.iter().flat_map(color).collect() };
        Ok(self.add_png(name, png::encode8(&picture, ColorTag::Srgb)?, "map of differences"))
    }

    fn add_png(&mut self, name: &str, bytes: Vec<u8>, alt: &str) -> String {
        let image = format!(
            "<img width=\"{}\" height=\"{}\" alt=\"{alt}\" src=\"data:image/png;base64,{}\">",
            self.frame.width,
            self.frame.height,
            base64(&bytes)
        );
        self.files.push((format!("{name}.png"), bytes));
        image
    }
}

/// The comment in a filtered .png file.
const DENOISED: &str = "Denoised by gonio: noise of the path tracer was removed by a filter that may be wrong.";

fn tag_of(map: &DisplayMap) -> ColorTag {
    match map {
        DisplayMap::Light(transform) if transform.encoding == ColorEncoding::Srgb => ColorTag::Srgb,
        _ => ColorTag::Untagged,
    }
}

fn mean_text(picture: &Picture) -> String {
    let sum: DVec3 = picture.pixels.iter().map(|&p| light(p)).sum();
    let [r, g, b] = (sum / picture.pixels.len().max(1) as f64).to_array();
    format!("picture with the mean colour {r:.3}, {g:.3}, {b:.3}")
}

/// RFC 4648.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let [a, b, c] = [0, 1, 2].map(|i| u32::from(group.get(i).copied().unwrap_or(0)));
        let bits = a << 16 | b << 8 | c;
        for digit in 0..4 {
            let is_there = digit <= group.len();
            text.push(if is_there { char::from(DIGITS[(bits >> (18 - 6 * digit) & 63) as usize]) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_rfc() {
        for (bytes, text) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")] {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
    }

    #[test]
    fn names_cannot_change_the_page() {
        assert_eq!(inline("Look at `<b>\u{1b}[2K`."), "Look at <b>&lt;b&gt;\\x1b[2K</b>.");
        assert_eq!(inline("#1 of #nothing ü#"), "#1 of #nothing ü#");
        assert_eq!(inline("(#00ff7f)"), "(<i class=\"swatch\" title=\"#00ff7f\" style=\"background: #00ff7f\"></i>)");
    }

    #[test]
    fn equations_break_before_the_integral() {
        let parts = |markup: &str| equation(markup).matches("<math>").count();
        assert_eq!([parts("L_o = E + ∫_Ω f dω_i"), parts("L = E + -{∫_Ω} !{Σ_N} x"), parts("L = E")], [2, 2, 1]);
        assert_eq!(parts("L = !{A + ∫_Ω} x"), 1);
        let struck = equation("L = -{∫_Ω} x");
        assert!(struck.contains("</math><math><mrow class=\"struck\">"), "{struck}");
        assert!(equation("f dω_i").contains("<mi>d</mi><msub><mrow><mi>ω</mi></mrow>"), "{}", equation("f dω_i"));
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!((percent(0.0), percent(0.12345), percent(0.012345)), ("0 %".into(), "12 %".into(), "1.2 %".into()));
        assert_eq!((rounded(1234.0), rounded(3.06), rounded(99.6)), ("1200".into(), "3.1".into(), "100".into()));
        assert_eq!(percent(0.00012345), "0.012 %");
        assert_eq!(
            [seconds(0.0123), seconds(1.26), seconds(90.4), seconds(2440.0), seconds(9000.0)],
            ["12.3 ms", "1.3 s", "90 s", "41 min", "2.5 h"]
        );
        assert_eq!(
            [signed_percent(0.031), signed_percent(-0.17), signed_percent(0.000064)],
            ["+3.1 %", "−17 %", "0 %"]
        );
    }
}
