//! A glyph and an advance for each character: as much of the crate `harfrust` as egui uses, for it stands in its place.
//!
//! Characters become glyphs by the font's character map, one each and from left to right; glyphs have the font's
//! advances, and pairs of them its kerning (`kerning`). A font's ligatures, marks and rules for scripts are left
//! out: the fonts of gonio have none.

mod kerning;

use kerning::Kerning;
use skrifa::instance::{Location, LocationRef, Size};
use skrifa::raw::types::Tag;
use skrifa::{FontRef, GlyphId, MetadataProvider};

/// An axis of a variable font, and where on it.
#[derive(Clone, Copy, Debug)]
pub struct Variation {
    /// The axis.
    pub tag: Tag,
    /// In the axis's own units.
    pub value: f32,
}

/// A place on the axes of a variable font.
pub struct ShaperInstance(Location);

impl ShaperInstance {
    /// The place with these values; axes that are not named are at their defaults.
    pub fn from_variations(font: &FontRef<'_>, variations: impl IntoIterator<Item = Variation>) -> Self {
        ShaperInstance(font.axes().location(variations.into_iter().map(|axis| (axis.tag, axis.value))))
    }
}

/// What is known of a font beforehand: nothing.
#[derive(Clone, Copy, Debug)]
pub struct ShaperData;

impl ShaperData {
    /// For this font.
    pub fn new(_: &FontRef<'_>) -> Self {
        ShaperData
    }

    /// A shaper of this font.
    pub fn shaper<'a>(&self, font: &'a FontRef<'a>) -> Shaper<'a> {
        Shaper { font, location: LocationRef::default() }
    }
}

/// Makes glyphs of text.
pub struct Shaper<'a> {
    font: &'a FontRef<'a>,
    location: LocationRef<'a>,
}

/// How to shape: there is but one way.
#[derive(Clone, Copy, Debug, Default)]
pub struct ShapeOptions;

impl ShapeOptions {
    /// That way.
    pub fn new() -> Self {
        ShapeOptions
    }
}

impl<'a> Shaper<'a> {
    /// At a place on a variable font's axes.
    pub fn instance(self, instance: Option<&'a ShaperInstance>) -> Self {
        Shaper { location: instance.map_or_else(LocationRef::default, |place| (&place.0).into()), ..self }
    }

    /// The shaper.
    pub fn build(self) -> Self {
        self
    }

    /// A glyph for each character; glyph 0 where the font has none for it.
    pub fn shape(&self, mut buffer: UnicodeBuffer, _: ShapeOptions) -> GlyphBuffer {
        let (characters, metrics) = (self.font.charmap(), self.font.glyph_metrics(Size::unscaled(), self.location));
        let kerning = Kerning::of(self.font);
        let mut before: Option<GlyphId> = None;
        for (cluster, character) in buffer.text.char_indices() {
            let glyph = characters.map(character).unwrap_or(GlyphId::NOTDEF);
            if let Some(before) = before
                && let Some(last) = buffer.positions.last_mut()
            {
                last.x_advance += kerning.between(before, glyph);
            }
            before = Some(glyph);
            // Texts are far below 4 GB; so long a one would only lose its clusters.
            let cluster = u32::try_from(cluster).unwrap_or(u32::MAX);
            buffer.infos.push(GlyphInfo { glyph_id: glyph.to_u32(), cluster });
            let advance = metrics.advance_width(glyph).unwrap_or(0.0);
            buffer.positions.push(GlyphPosition { x_advance: advance.round() as i32, x_offset: 0, y_offset: 0 });
        }
        GlyphBuffer(buffer)
    }
}

/// Where in a paragraph a text stands. It changes nothing here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BufferFlags;

impl BufferFlags {
    /// At its beginning.
    pub const BEGINNING_OF_TEXT: BufferFlags = BufferFlags;
    /// At its end.
    pub const END_OF_TEXT: BufferFlags = BufferFlags;

    /// Neither.
    pub fn empty() -> Self {
        BufferFlags
    }
}

impl std::ops::BitOrAssign for BufferFlags {
    fn bitor_assign(&mut self, _: Self) {}
}

/// Text to be shaped. Its memory is used again from text to text.
#[derive(Debug, Default)]
pub struct UnicodeBuffer {
    text: String,
    infos: Vec<GlyphInfo>,
    positions: Vec<GlyphPosition>,
}

impl UnicodeBuffer {
    /// Empty.
    pub fn new() -> Self {
        UnicodeBuffer::default()
    }

    /// See [`BufferFlags`].
    pub fn set_flags(&mut self, _: BufferFlags) {}

    /// Adds text.
    pub fn push_str(&mut self, text: &str) {
        self.text.push_str(text);
    }

    /// Script and direction: there is but one.
    pub fn guess_segment_properties(&mut self) {}
}

/// A glyph, and where in the text it comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GlyphInfo {
    /// Its number in the font.
    pub glyph_id: u32,
    /// The byte of the text at which its character begins.
    pub cluster: u32,
}

/// How far a glyph moves the pen, and how far it stands from the pen; in units of the font.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GlyphPosition {
    /// To the right, with the kerning towards the next.
    pub x_advance: i32,
    /// To the right.
    pub x_offset: i32,
    /// Upwards.
    pub y_offset: i32,
}

/// Shaped text.
#[derive(Debug)]
pub struct GlyphBuffer(UnicodeBuffer);

impl GlyphBuffer {
    /// The glyphs.
    pub fn glyph_infos(&self) -> &[GlyphInfo] {
        &self.0.infos
    }

    /// One for each glyph.
    pub fn glyph_positions(&self) -> &[GlyphPosition] {
        &self.0.positions
    }

    /// The memory, for the next text.
    pub fn clear(self) -> UnicodeBuffer {
        let mut buffer = self.0;
        buffer.text.clear();
        buffer.infos.clear();
        buffer.positions.clear();
        buffer
    }
}
