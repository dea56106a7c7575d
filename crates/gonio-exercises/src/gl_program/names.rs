//! The mistakes that a GL program can have, in words. Ids stay as they are: they stand in results of machines.

/// A mistake in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GlProgramMistakeName {
    /// Its word.
    pub id: &'static str,
    /// The mistake in half a sentence.
    pub name: &'static str,
    /// Why that matters.
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

/// The words of a mistake.
pub fn name_of(id: &str) -> Option<&'static GlProgramMistakeName> {
    NAMES.iter().find(|name| name.id == id)
}

mistakes! {
    // Samplers and units
    "texture-name-as-unit": "the sampler is set to the texture's name instead of its unit",
        "A sampler takes the number of a texture unit. The name of a texture is another number, chosen by OpenGL.",
        "black, without any error", "give the sampler the unit that the texture is bound to";
    "unbound-unit": "the sampler reads another unit than the texture is bound to",
        "Where nothing is bound, a sampler reads black, and OpenGL reports no error.",
        "black, without any error", "bind the texture to the unit that the sampler reads, or set the sampler to that unit";
    "active-texture-after-bind": "the unit is made active after the texture was bound",
        "bind_texture binds to the unit that is active at that moment.",
        "black, without any error", "write active_texture before bind_texture";
    "active-texture-number": "active_texture is given a plain number",
        "Units are written TEXTURE0, TEXTURE1 and so on; OpenGL rejects 0 and 1 here.",
        "black, or the wrong texture", "write TEXTURE0 and so on";
    "sampler-never-set": "the sampler is never set, and reads unit 0",
        "A sampler that is not set reads unit 0, and the texture is bound to another one.",
        "black, without any error", "set the sampler to the texture's unit, with uniform_1i after use_program";
    "uniform-before-use-program": "the uniform is set before its program is in use",
        "uniform_1i sets a uniform of the program in use. Without one, OpenGL rejects the call, and the uniform \
         stays 0.",
        "black; OpenGL reports INVALID_OPERATION", "call use_program first";
    "uniform-after-draw": "the uniform is set after the draw",
        "A draw reads what the uniforms hold at that moment.",
        "black in the first frame", "set it before the draw";
    "uniform-name-wrong": "the program has no uniform of that name",
        "The location of an unknown name is -1, which OpenGL ignores without an error.",
        "as if the uniform were never set", "write the name as in the shader";
    "uniform-type-wrong": "the uniform is set by the call of another type",
        "A sampler is an integer: OpenGL rejects uniform_1f for it.",
        "as if the uniform were never set", "use uniform_1i";
    // Textures
    "mipmaps-missing": "the filter needs mipmaps, and there are none",
        "A texture without the mipmaps that its filter needs is incomplete, and reads as black.",
        "black, without any error", "call generate_mipmap after tex_image_2d, or take a filter without mipmaps";
    "filter-never-set": "the filter is never set: the default needs mipmaps, and there are none",
        "The minifying filter that a texture starts with is NEAREST_MIPMAP_LINEAR.",
        "black, without any error", "set TEXTURE_MIN_FILTER to LINEAR, or call generate_mipmap";
    "mipmaps-before-image": "the mipmaps are made before the image is there",
        "generate_mipmap computes the smaller levels from level 0 as it is at that moment.",
        "black, without any error", "call generate_mipmap after tex_image_2d";
    "mipmaps-misplaced": "the mipmaps are made of another texture",
        "generate_mipmap works on the texture that is bound to the active unit at that moment.",
        "a black triangle", "call generate_mipmap right after tex_image_2d";
    "filter-refused": "OpenGL rejects the filter",
        "TEXTURE_MAG_FILTER is NEAREST or LINEAR; the ones with mipmaps are for TEXTURE_MIN_FILTER.",
        "black, if the other filter then needs mipmaps", "give the filter to TEXTURE_MIN_FILTER";
    "wrong-target": "the texture is used with the target of another kind",
        "A sampler2D reads what is bound to TEXTURE_2D, a samplerCube what is bound to TEXTURE_CUBE_MAP.",
        "a black triangle", "write TEXTURE_2D in all calls for this texture";
    "texture-not-bound": "the texture is never bound",
        "A texture exists from its first bind_texture on; all calls for it need it bound.",
        "black; OpenGL reports INVALID_OPERATION", "call bind_texture before the texture's other calls";
    "texture-bound-late": "the texture is bound after the calls that are meant for it",
        "tex_image_2d and tex_parameter work on the texture that is bound at that moment.",
        "a black triangle", "call bind_texture before them";
    "texture-unbound": "the texture is unbound before the draw",
        "bind_texture with 0 empties the unit.",
        "black, without any error", "leave that call out, or bind the texture again before the draw";
    "other-texture-bound": "another texture is bound to the unit that the sampler reads",
        "A unit holds one texture of each kind: the last one that was bound while it was active.",
        "another picture, or black", "make another unit active before the other texture is bound";
    "texture-deleted": "the texture is deleted before the draw",
        "A deleted texture is unbound wherever it was bound.",
        "black, without any error", "delete it after the last draw that reads it";
    "internal-format-wrong": "the texture is kept in a format that loses or changes its colours",
        "R8 keeps the red channel alone; SRGB8 is decoded when it is read, so that all is darker.",
        "red, or too dark", "write RGB8";
    "image-level-wrong": "the image is given to another level than 0",
        "Level 0 is the largest one, and the others are its mipmaps.",
        "a black triangle", "give the image to level 0";
    "image-missing": "the texture never gets an image",
        "A texture without an image has nothing to be read.",
        "a black triangle", "call tex_image_2d";
    "image-wrong": "it is another image", "Another file is loaded than the exercise asks for.",
        "another pattern", "load the exercise's image";
    "level-range-wrong": "the levels that may be read are not the ones that are there",
        "TEXTURE_BASE_LEVEL and TEXTURE_MAX_LEVEL say which levels belong to the texture.",
        "black, or blurred", "leave these two calls out";
    // Vertices
    "stride-wrong": "the stride is wrong",
        "The stride is the number of bytes from one vertex to the next: all that a vertex has in the buffer.",
        "no triangle, or a torn one", "write the size of a whole vertex, in bytes";
    "offset-wrong": "the offset of an attribute is wrong",
        "The offset is the number of bytes before the attribute in the first vertex.",
        "the attribute shows another one's numbers", "count the bytes of all attributes before it";
    "attribute-size-wrong": "the attribute has another number of components",
        "The size is how many numbers each vertex has of this attribute, 1 to 4; what is missing is 0, 0, 1.",
        "flat, torn, or in other colours", "write as many as the data has";
    "attribute-type-wrong": "the attribute's numbers are of another type",
        "The type says how OpenGL reads the bytes of the buffer.",
        "nothing, or noise", "write FLOAT";
    "attribute-not-enabled": "the attribute is not enabled",
        "An attribute that is not enabled has the same value for every vertex: (0, 0, 0, 1).",
        "one colour all over, one texel all over, or no triangle", "call enable_vertex_attrib_array for it";
    "attribute-disabled": "the attribute is disabled before the draw",
        "An attribute that is not enabled has the same value for every vertex: (0, 0, 0, 1).",
        "one colour all over, one texel all over, or no triangle", "leave disable_vertex_attrib_array out";
    "attribute-not-described": "nothing says where the attribute is",
        "Without vertex_attrib_pointer an attribute has no place in any buffer.",
        "no triangle", "call vertex_attrib_pointer for it";
    "attribute-name-wrong": "the program has no attribute of that name",
        "The location of an unknown name is -1, which OpenGL refuses.",
        "as if the attribute were not enabled", "write the name as in the vertex shader";
    "vertex-array-missing": "there is no vertex array",
        "OpenGL's core profile keeps attributes in a vertex array only.",
        "no triangle; OpenGL reports INVALID_OPERATION", "make one with gen_vertex_array and bind it";
    "vertex-array-not-bound": "the vertex array is never bound",
        "Attributes are kept in the vertex array that is bound.",
        "no triangle; OpenGL reports INVALID_OPERATION", "call bind_vertex_array before the attributes are described";
    "vertex-array-bound-late": "the vertex array is bound after the attributes were described",
        "Attributes are kept in the vertex array that is bound at that moment.",
        "no triangle", "call bind_vertex_array first";
    "vertex-array-unbound": "no vertex array is bound at the draw",
        "A draw reads the attributes of the vertex array that is bound.",
        "no triangle; OpenGL reports INVALID_OPERATION", "bind the vertex array again before the draw";
    "other-vertex-array": "another vertex array is bound at the draw",
        "A draw reads the attributes of the vertex array that is bound.",
        "no triangle, or another one", "bind the vertex array in which the attributes were described";
    "vertex-array-deleted": "the vertex array is deleted before the draw",
        "With it go all that it keeps of the attributes.", "no triangle", "delete it after the last draw";
    "buffer-not-bound": "the buffer is never bound",
        "buffer_data fills, and vertex_attrib_pointer refers to, the buffer that is bound.",
        "no triangle", "call bind_buffer ARRAY_BUFFER first";
    "buffer-bound-late": "the buffer is bound after the calls that are meant for it",
        "buffer_data fills, and vertex_attrib_pointer refers to, the buffer that is bound at that moment.",
        "no triangle", "call bind_buffer before them";
    "buffer-unbound": "the buffer is unbound before the attributes are described",
        "vertex_attrib_pointer refers to the buffer that is bound to ARRAY_BUFFER at that moment.",
        "no triangle", "unbind it after vertex_attrib_pointer, or never";
    "buffer-target-wrong": "the buffer is bound to the wrong target",
        "Vertices are read from ARRAY_BUFFER, indices from ELEMENT_ARRAY_BUFFER.",
        "no triangle", "bind vertices to ARRAY_BUFFER";
    "buffer-empty": "the buffer is never filled",
        "A buffer has no bytes until buffer_data gives it some.", "no triangle", "call buffer_data";
    "buffer-deleted": "the buffer is deleted before the draw",
        "The vertex array that is bound lets go of it.", "no triangle", "delete it after the last draw";
    "other-data": "the buffer is filled with another list",
        "The draw reads what the buffer was filled with last.", "another shape", "give buffer_data the corners";
    "data-changed": "the corners are not the exercise's",
        "The mistake is in a call; the numbers of the corners were right.", "another triangle, or other colours",
        "put the numbers back as they were";
    "index-type-wrong": "the indices are of another type",
        "The type of draw_elements is that of the numbers in the index buffer: here UNSIGNED_INT, four bytes each.",
        "no triangle, or a torn one", "write UNSIGNED_INT";
    "index-offset-wrong": "the draw begins at the wrong index",
        "The last argument of draw_elements counts bytes.", "another triangle, or none", "write 0";
    "indices-from-one": "the indices count from 1",
        "The first vertex of a buffer has the index 0; in .obj files it has 1.", "a corner is missing or another one",
        "subtract 1 from each index";
    "indices-changed": "the indices name other corners", "Each index is the number of a corner, from 0.",
        "another triangle", "write 0 1 2";
    "index-buffer-not-bound": "no index buffer is bound in the vertex array",
        "A vertex array keeps the ELEMENT_ARRAY_BUFFER that is bound while it is bound.",
        "no triangle", "bind the index buffer after the vertex array";
    // Programs, draws, and the picture
    "program-not-used": "the program is never put to use",
        "A draw runs the program in use; linking does not put it to use.", "no triangle", "call use_program";
    "program-switched-off": "no program is in use at the draw",
        "use_program with 0 puts none to use.", "no triangle", "put the program to use before the draw";
    "program-number-wrong": "use_program is given a number that is not a program",
        "The number of a program is what create_program returned.", "no triangle", "give it what create_program \
            returned";
    "draw-missing": "nothing is drawn", "Without a draw call there is only the ground.", "no triangle",
        "call draw_arrays";
    "draw-count-wrong": "the number of vertices is wrong",
        "The count is that of the vertices, not of the triangles and not of the numbers.", "no triangle, or a part \
            of it",
        "write 3";
    "draw-first-wrong": "the draw begins at the wrong vertex", "The first vertex is 0.", "no triangle, or another one",
        "write 0";
    "draw-mode-wrong": "the vertices are joined in another way", "TRIANGLES fills one for each three vertices.",
        "points or lines", "write TRIANGLES";
    "draw-too-early": "the draw comes before all is ready",
        "A draw reads what is there at that moment; what is set later is for the next draw.",
        "no triangle, or a black one", "draw after everything else";
    "viewport-wrong": "the viewport is not the whole picture",
        "viewport says where on the picture the clip space's square lies.", "no triangle, or a small one in a corner",
        "give it 0, 0 and the picture's size, or leave it out";
    "clear-missing": "the picture is never cleared", "What is not drawn over keeps what was there.",
        "another ground", "call clear COLOR_BUFFER_BIT before the draw";
    "clear-after-draw": "the picture is cleared after the draw", "clear wipes out what was drawn.", "only the ground",
        "clear first, then draw";
    "clear-color-late": "the ground's colour is set after clear", "clear takes the colour as it is at that moment.",
        "another ground", "set clear_color before clear";
    "clear-color-wrong": "the ground has another colour", "clear fills the picture with the colour of clear_color.",
        "another ground", "write clear_color 0.2 0.25 0.3 1.0";
    "culled": "the triangle's face is culled", "With CULL_FACE, faces whose corners go clockwise are not drawn.",
        "no triangle", "leave CULL_FACE off, or turn the order of the corners";
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
    fn each_id_is_a_word_with_all_that_is_said_of_it() {
        let ids: BTreeSet<_> = names().iter().map(|name| name.id).collect();
        assert_eq!(ids.len(), names().len(), "no id stands twice");
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
        // Kebab-case words in the suspicions are ids.
        let words = SUSPECTS.iter().flat_map(|text| text.split('"'));
        let is_id = |word: &&str| word.contains('-') && word.chars().all(|c| c.is_ascii_lowercase() || c == '-');
        let used: BTreeSet<&str> = words.filter(is_id).collect();
        assert!(used.len() >= 55);
        for id in used {
            assert!(name_of(id).is_some(), "{id} has no words");
        }
    }
}
