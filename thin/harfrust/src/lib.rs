//! A glyph and an advance for each character: a replacement of the crate `harfrust` with the part of it that egui uses.
//!
//! The font's character map gives one glyph per character, from left to right, with the font's advances and kerning
//! (`kerning`). Ligatures, marks and rules for scripts are left out: gonio's fonts have none.

mod kerning;

use kerning::Kerning;
use skrifa::instance::{Location, LocationRef, Size};
use skrifa::raw::types::Tag;
use skrifa::{FontRef, GlyphId, MetadataProvider};

/// An axis of a variable font and a value on it.
#[derive(Clone, Copy, Debug)]
pub struct Variation {
    /// The axis.
    pub tag: Tag,
    /// The value, in the axis's own units.
    pub value: f32,
}

/// A value for each axis of a variable font.
pub struct ShaperInstance(Location);

impl ShaperInstance {
    /// An instance with these values; other axes have their defaults.
    pub fn from_variations(font: &FontRef<'_>, variations: impl IntoIterator<Item = Variation>) -> Self {
        ShaperInstance(font.axes().location(variations.into_iter().map(|axis| (axis.tag, axis.value))))
    }
}

/// Data prepared for a font: nothing here.
#[derive(Clone, Copy, Debug)]
pub struct ShaperData;

impl ShaperData {
    /// Prepares the data of this font.
    pub fn new(_: &FontRef<'_>) -> Self {
        ShaperData
    }

    /// Begins a shaper for this font.
    pub fn shaper<'a>(&self, font: &'a FontRef<'a>) -> Shaper<'a> {
        Shaper { font, location: LocationRef::default() }
    }
}

/// Converts text to glyphs.
pub struct Shaper<'a> {
    font: &'a FontRef<'a>,
    location: LocationRef<'a>,
}

/// Settings of shaping, of which there are none.
#[derive(Clone, Copy, Debug, Default)]
pub struct ShapeOptions;

impl ShapeOptions {
    /// The default settings.
    pub fn new() -> Self {
        ShapeOptions
    }
}

impl<'a> Shaper<'a> {
    /// Sets the values on a variable font's axes.
    pub fn instance(self, instance: Option<&'a ShaperInstance>) -> Self {
        Shaper { location: instance.map_or_else(LocationRef::default, |place| (&place.0).into()), ..self }
    }

    /// The shaper.
    pub fn build(self) -> Self {
        self
    }

    /// Returns a glyph for each character; glyph 0 where the font has none.
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
            // Texts are far shorter than 4 GB; a longer one would only lose its clusters.
            let cluster = u32::try_from(cluster).unwrap_or(u32::MAX);
            buffer.infos.push(GlyphInfo { glyph_id: glyph.to_u32(), cluster });
            let advance = metrics.advance_width(glyph).unwrap_or(0.0);
            buffer.positions.push(GlyphPosition { x_advance: advance.round() as i32, x_offset: 0, y_offset: 0 });
        }
        GlyphBuffer(buffer)
    }
}

/// The position of a text in its paragraph. It has no effect here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BufferFlags;

impl BufferFlags {
    /// The paragraph begins with the text.
    pub const BEGINNING_OF_TEXT: BufferFlags = BufferFlags;
    /// The paragraph ends with the text.
    pub const END_OF_TEXT: BufferFlags = BufferFlags;

    /// No position.
    pub fn empty() -> Self {
        BufferFlags
    }
}

impl std::ops::BitOrAssign for BufferFlags {
    fn bitor_assign(&mut self, _: Self) {}
}

/// Text to shape. Its memory is reused from text to text.
#[derive(Debug, Default)]
pub struct UnicodeBuffer {
    text: String,
    infos: Vec<GlyphInfo>,
    positions: Vec<GlyphPosition>,
}

impl UnicodeBuffer {
    /// An empty buffer.
    pub fn new() -> Self {
        UnicodeBuffer::default()
    }

    /// Sets the position in the paragraph.
    pub fn set_flags(&mut self, _: BufferFlags) {}

    /// Appends text.
    pub fn push_str(&mut self, text: &str) {
        self.text.push_str(text);
    }

    /// Does nothing: there is one script and one direction.
    pub fn guess_segment_properties(&mut self) {}
}

/// A glyph and the place of its character in the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GlyphInfo {
    /// The glyph's index in the font.
    pub glyph_id: u32,
    /// The byte of the text at which its character begins.
    pub cluster: u32,
}

/// The advance of a glyph and its offset from the pen, in font units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GlyphPosition {
    /// Horizontal advance, with the kerning towards the next glyph.
    pub x_advance: i32,
    /// Horizontal offset, to the right.
    pub x_offset: i32,
    /// Vertical offset, upwards.
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

    /// The positions of the glyphs.
    pub fn glyph_positions(&self) -> &[GlyphPosition] {
        &self.0.positions
    }

    /// Returns the memory for the next text.
    pub fn clear(self) -> UnicodeBuffer {
        let mut buffer = self.0;
        buffer.text.clear();
        buffer.infos.clear();
        buffer.positions.clear();
        buffer
    }
}
