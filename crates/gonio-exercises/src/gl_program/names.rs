//! The texts of the mistakes that a GL program can have. Ids never change: programs read them in results.

/// The texts of a mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GlProgramMistakeName {
    /// Its id.
    pub id: &'static str,
    /// The mistake in half a sentence.
    pub name: &'static str,
    /// The rule of OpenGL behind it.
    pub explanation: &'static str,
    /// The symptom in the picture.
    pub looks_like: &'static str,
    /// How to fix it.
    pub fix: &'static str,
}

macro_rules! mistakes {
    ($($id:literal: $name:literal, $explanation:literal, $looks_like:literal, $fix:literal;)+) => {
        const NAMES: &[GlProgramMistakeName] = &[$(GlProgramMistakeName {
            id: $id, name: $name, explanation: $explanation, looks_like: $looks_like, fix: $fix,
        }),+];
    };
}

/// All mistakes that a check can name.
pub fn names() -> &'static [GlProgramMistakeName] {
    NAMES
}

/// The texts of a mistake.
pub fn name_of(id: &str) -> Option<&'static GlProgramMistakeName> {
    NAMES.iter().find(|name| name.id == id)
}

mistakes! {
    // Samplers and units
    "texture-name-as-unit": "the sampler is set to the texture's name instead of its unit",
        "A sampler takes the number of a texture unit. The name of a texture is another number, chosen by OpenGL.",
        "black, without any error", "give the sampler the unit that the texture is bound to";
    "unbound-unit": "the sampler reads a different unit from the one that the texture is bound to",
        "A sampler reads black from a unit without a texture, and OpenGL reports no error.",
        "black, without any error", "bind the texture to the unit that the sampler reads, or set the sampler to that unit";
    "active-texture-after-bind": "the unit is made active after the texture was bound",
        "bind_texture binds to the unit that is active at that moment.",
        "black, without any error", "write active_texture before bind_texture";
    "active-texture-number": "active_texture gets a plain number",
        "Units are called TEXTURE0, TEXTURE1 and so on; OpenGL rejects 0 and 1 here.",
        "black, or the wrong texture", "write TEXTURE0 and so on";
    "sampler-never-set": "the sampler is never set, and reads unit 0",
        "A sampler that is not set reads unit 0, but the texture is bound to another unit.",
        "black, without any error", "set the sampler to the texture's unit, with uniform_1i after use_program";
    "uniform-before-use-program": "the uniform is set before its program is in use",
        "uniform_1i sets a uniform of the program in use. Without one, OpenGL rejects the call, and the uniform \
         stays 0.",
        "black; OpenGL reports INVALID_OPERATION", "call use_program first";
    "uniform-after-draw": "the uniform is set after the draw",
        "A draw uses the values that the uniforms have at that moment.",
        "black in the first frame", "set it before the draw";
    "uniform-name-wrong": "the program has no uniform of that name",
        "The location of an unknown name is -1, which OpenGL ignores without an error.",
        "as if the uniform were never set", "write the name as in the shader";
    "uniform-type-wrong": "the uniform is set by the call for another type",
        "A sampler is an integer: OpenGL rejects uniform_1f for it.",
        "as if the uniform were never set", "use uniform_1i";
    // Textures
    "mipmaps-missing": "the filter needs mipmaps, but there are none",
        "A texture without the mipmaps that its filter needs is incomplete, and reads as black.",
        "black, without any error", "call generate_mipmap after tex_image_2d, or use a filter without mipmaps";
    "filter-never-set": "the filter is never set: the default needs mipmaps, but there are none",
        "The default minification filter of a texture is NEAREST_MIPMAP_LINEAR.",
        "black, without any error", "set TEXTURE_MIN_FILTER to LINEAR, or call generate_mipmap";
    "mipmaps-before-image": "the mipmaps are generated before the image is set",
        "generate_mipmap computes the smaller levels from the content of level 0 at that moment.",
        "black, without any error", "call generate_mipmap after tex_image_2d";
    "mipmaps-misplaced": "the mipmaps are generated for another texture",
        "generate_mipmap works on the texture that is bound to the active unit at that moment.",
        "a black triangle", "call generate_mipmap right after tex_image_2d";
    "filter-refused": "OpenGL rejects the filter",
        "TEXTURE_MAG_FILTER can only be NEAREST or LINEAR; filters with mipmaps are for TEXTURE_MIN_FILTER.",
        "black, if the other filter then needs mipmaps", "set TEXTURE_MIN_FILTER to this filter";
    "wrong-target": "the texture is used with the target of another kind of texture",
        "A sampler2D reads the texture bound to TEXTURE_2D, a samplerCube the one bound to TEXTURE_CUBE_MAP.",
        "a black triangle", "write TEXTURE_2D in all calls for this texture";
    "texture-not-bound": "the texture is never bound",
        "A texture exists once it has been bound, and all calls for it work on the bound texture.",
        "black; OpenGL reports INVALID_OPERATION", "call bind_texture before the texture's other calls";
    "texture-bound-late": "the texture is bound after the calls that are meant for it",
        "tex_image_2d and tex_parameter work on the texture that is bound at that moment.",
        "a black triangle", "call bind_texture before them";
    "texture-unbound": "the texture is unbound before the draw",
        "bind_texture with 0 unbinds the unit's texture.",
        "black, without any error", "remove that call, or bind the texture again before the draw";
    "other-texture-bound": "another texture is bound to the unit that the sampler reads",
        "A unit has one texture of each kind: the last one that was bound while the unit was active.",
        "another image, or black", "make another unit active before binding the other texture";
    "texture-deleted": "the texture is deleted before the draw",
        "Deleting a texture unbinds it from all units.",
        "black, without any error", "delete it after the last draw that reads it";
    "internal-format-wrong": "the texture's internal format loses or changes its colours",
        "R8 keeps only the red channel; SRGB8 is decoded when it is read, so everything is darker.",
        "red, or too dark", "write RGB8";
    "image-level-wrong": "the image is passed to a level other than 0",
        "Level 0 is the full image, and the others are its mipmaps.",
        "a black triangle", "pass the image to level 0";
    "image-missing": "the texture never gets an image",
        "A texture without an image reads as black.",
        "a black triangle", "call tex_image_2d";
    "image-wrong": "the wrong image is loaded", "The exercise asks for a different file.",
        "another pattern", "load the exercise's image";
    "level-range-wrong": "the range of levels does not match the levels that exist",
        "TEXTURE_BASE_LEVEL and TEXTURE_MAX_LEVEL define which levels belong to the texture.",
        "black, or blurred", "remove these two calls";
    // Vertices
    "stride-wrong": "the stride is wrong",
        "The stride is the number of bytes from one vertex to the next: the size of a whole vertex in the buffer.",
        "no triangle, or a torn one", "write the size of a whole vertex, in bytes";
    "offset-wrong": "the offset of an attribute is wrong",
        "The offset is the number of bytes before the attribute in the first vertex.",
        "the attribute has the values of another one", "count the bytes of all attributes before it";
    "attribute-size-wrong": "the attribute has the wrong number of components",
        "The size is the number of components per vertex, 1 to 4; missing ones are 0, 0, 1.",
        "flat, torn, or in other colours", "write the number of components in the data";
    "attribute-type-wrong": "the attribute has the wrong type",
        "The type defines how OpenGL reads the bytes of the buffer.",
        "nothing, or noise", "write FLOAT";
    "attribute-not-enabled": "the attribute is not enabled",
        "An attribute that is not enabled has the same value for every vertex: (0, 0, 0, 1).",
        "one colour everywhere, one texel everywhere, or no triangle", "call enable_vertex_attrib_array for it";
    "attribute-disabled": "the attribute is disabled before the draw",
        "An attribute that is not enabled has the same value for every vertex: (0, 0, 0, 1).",
        "one colour everywhere, one texel everywhere, or no triangle", "remove disable_vertex_attrib_array";
    "attribute-not-described": "the attribute is never described",
        "Without vertex_attrib_pointer, OpenGL does not know where the attribute's data is.",
        "no triangle", "call vertex_attrib_pointer for it";
    "attribute-name-wrong": "the program has no attribute of that name",
        "The location of an unknown name is -1, which OpenGL rejects.",
        "as if the attribute were not enabled", "write the name as in the vertex shader";
    "vertex-array-missing": "there is no vertex array",
        "In OpenGL's core profile, attributes are stored only in vertex arrays.",
        "no triangle; OpenGL reports INVALID_OPERATION", "create one with gen_vertex_array and bind it";
    "vertex-array-not-bound": "the vertex array is never bound",
        "Attributes are stored in the bound vertex array.",
        "no triangle; OpenGL reports INVALID_OPERATION", "call bind_vertex_array before the attributes are described";
    "vertex-array-bound-late": "the vertex array is bound after the attributes were described",
        "Attributes are stored in the vertex array that is bound at that moment.",
        "no triangle", "call bind_vertex_array first";
    "vertex-array-unbound": "no vertex array is bound at the draw",
        "A draw reads the attributes of the vertex array that is bound.",
        "no triangle; OpenGL reports INVALID_OPERATION", "bind the vertex array again before the draw";
    "other-vertex-array": "another vertex array is bound at the draw",
        "A draw reads the attributes of the vertex array that is bound.",
        "no triangle, or another one", "bind the vertex array in which the attributes were described";
    "vertex-array-deleted": "the vertex array is deleted before the draw",
        "Deleting a vertex array deletes its description of the attributes.", "no triangle", "delete it after the last draw";
    "buffer-not-bound": "the buffer is never bound",
        "buffer_data fills the bound buffer, and vertex_attrib_pointer refers to it.",
        "no triangle", "call bind_buffer ARRAY_BUFFER first";
    "buffer-bound-late": "the buffer is bound after the calls that are meant for it",
        "buffer_data fills the buffer that is bound at that moment, and vertex_attrib_pointer refers to it.",
        "no triangle", "call bind_buffer before them";
    "buffer-unbound": "the buffer is unbound before the attributes are described",
        "vertex_attrib_pointer refers to the buffer that is bound to ARRAY_BUFFER at that moment.",
        "no triangle", "unbind it after vertex_attrib_pointer, or not at all";
    "buffer-target-wrong": "the buffer is bound to the wrong target",
        "Vertices are read from ARRAY_BUFFER, indices from ELEMENT_ARRAY_BUFFER.",
        "no triangle", "bind vertices to ARRAY_BUFFER";
    "buffer-empty": "the buffer is never filled",
        "A buffer is empty until buffer_data fills it.", "no triangle", "call buffer_data";
    "buffer-deleted": "the buffer is deleted before the draw",
        "Deleting a buffer detaches it from the bound vertex array.", "no triangle", "delete it after the last draw";
    "other-data": "the buffer is filled with another list",
        "The draw reads the data that the buffer was filled with last.", "another shape", "pass the corners to buffer_data";
    "data-changed": "the corners are not the exercise's",
        "The mistake is in a call; the numbers of the corners were right.", "another triangle, or other colours",
        "restore the original numbers";
    "index-type-wrong": "the indices have the wrong type",
        "The type in draw_elements is the type of the indices in the buffer: here UNSIGNED_INT, four bytes each.",
        "no triangle, or a torn one", "write UNSIGNED_INT";
    "index-offset-wrong": "the draw begins at the wrong index",
        "The last argument of draw_elements is an offset in bytes.", "another triangle, or none", "write 0";
    "indices-from-one": "the indices count from 1",
        "The first vertex of a buffer has index 0; in .obj files it has index 1.", "a corner is missing or wrong",
        "subtract 1 from each index";
    "indices-changed": "the indices refer to other corners", "Each index is the number of a corner, from 0.",
        "another triangle", "write 0 1 2";
    "index-buffer-not-bound": "no index buffer is bound in the vertex array",
        "A vertex array stores the ELEMENT_ARRAY_BUFFER that is bound while the vertex array is bound.",
        "no triangle", "bind the index buffer after the vertex array";
    // Programs, draws, and the picture
    "program-not-used": "the program is never used",
        "A draw runs the program in use; linking a program does not select it.", "no triangle", "call use_program";
    "program-switched-off": "no program is in use at the draw",
        "use_program with 0 deselects the program.", "no triangle", "call use_program with the program before the draw";
    "program-number-wrong": "use_program gets a number that is not a program",
        "create_program returns the number of a program.", "no triangle", "pass the number that create_program \
            returned";
    "draw-missing": "nothing is drawn", "Without a draw call, there is only the background.", "no triangle",
        "call draw_arrays";
    "draw-count-wrong": "the number of vertices is wrong",
        "The count is the number of vertices, not of triangles or floats.", "no triangle, or a part \
            of it",
        "write 3";
    "draw-first-wrong": "the draw begins at the wrong vertex", "The first vertex is 0.", "no triangle, or another one",
        "write 0";
    "draw-mode-wrong": "the vertices are connected in another way", "TRIANGLES draws one triangle for every three vertices.",
        "points or lines", "write TRIANGLES";
    "draw-too-early": "the draw comes before everything is set up",
        "A draw uses the state at that moment; later calls affect the next draw.",
        "no triangle, or a black one", "draw after everything else";
    "viewport-wrong": "the viewport is not the whole picture",
        "viewport defines where clip space is mapped to on the picture.", "no triangle, or a small one in a corner",
        "set it to 0, 0 and the picture's size, or remove it";
    "clear-missing": "the picture is never cleared", "Pixels that are not drawn keep their previous content.",
        "another background", "call clear COLOR_BUFFER_BIT before the draw";
    "clear-after-draw": "the picture is cleared after the draw", "clear erases what was drawn.", "only the background",
        "clear first, then draw";
    "clear-color-late": "the background colour is set after clear", "clear uses the colour that is set at that moment.",
        "another background", "set clear_color before clear";
    "clear-color-wrong": "the background has the wrong colour", "clear fills the picture with the colour of clear_color.",
        "another background", "write clear_color 0.2 0.25 0.3 1.0";
    "culled": "the triangle's face is culled", "With CULL_FACE, faces with clockwise corners are not drawn.",
        "no triangle", "disable CULL_FACE, or reverse the order of the corners";
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    const SUSPECTS: [&str; 3] = [
        include_str!("suspects/picture.rs"),
        include_str!("suspects/textures.rs"),
        include_str!("suspects/vertices.rs"),
    ];
    const TESTS: [&str; 1] = [include_str!("tests/broken.rs")];

    #[test]
    fn each_id_is_unique_and_has_all_texts() {
        let ids: BTreeSet<_> = names().iter().map(|name| name.id).collect();
        assert_eq!(ids.len(), names().len(), "no id occurs twice");
        assert!(ids.len() >= 55, "{}", ids.len());
        for name in names() {
            assert!(name.id.chars().all(|c| c.is_ascii_lowercase() || c == '-'), "{}", name.id);
            for words in [name.name, name.explanation, name.looks_like, name.fix] {
                assert!(words.len() > 4 && !words.ends_with(' '), "{}: `{words}`", name.id);
            }
            assert!(!name.name.ends_with('.') && name.explanation.ends_with('.'), "{}", name.id);
        }
        assert_eq!(name_of("wrong-target").map(|name| name.id), Some("wrong-target"));
        assert_eq!(name_of("Wrong-Target"), None);
    }

    #[test]
    fn each_id_is_suspected_somewhere_and_named_in_a_test() {
        let is_in = |texts: &[&str], id: &str| texts.iter().any(|text| text.contains(&format!("\"{id}\"")));
        let not_in =
            |texts: &[&str]| names().iter().map(|name| name.id).filter(|id| !is_in(texts, id)).collect::<Vec<_>>();
        assert_eq!(not_in(&SUSPECTS), [""; 0], "never suspected");
        assert_eq!(not_in(&TESTS), [""; 0], "in no test");
        // Kebab-case words in the suspects are ids.
        let words = SUSPECTS.iter().flat_map(|text| text.split('"'));
        let is_id = |word: &&str| word.contains('-') && word.chars().all(|c| c.is_ascii_lowercase() || c == '-');
        let used: BTreeSet<&str> = words.filter(is_id).collect();
        assert!(used.len() >= 55);
        for id in used {
            assert!(name_of(id).is_some(), "{id} has no texts");
        }
    }
}
