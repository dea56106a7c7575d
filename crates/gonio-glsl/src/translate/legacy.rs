//! Replaces the variables of old OpenGL by attributes, varyings and uniforms.

use super::Translator;
use crate::Stage;

/// Old name, replacement, and declaration; `{}` is `out` or `in`.
const VERTEX: [(&str, &str, &str); 9] = [
    ("gl_Vertex", "gonio_Vertex", "in vec4 gonio_Vertex;"),
    ("gl_Normal", "gonio_Normal", "in vec3 gonio_Normal;"),
    ("gl_Color", "gonio_VertexColor", "in vec4 gonio_VertexColor;"),
    ("gl_MultiTexCoord0", "gonio_MultiTexCoord0", "in vec4 gonio_MultiTexCoord0;"),
    ("gl_FrontColor", "gonio_Color", "out vec4 gonio_Color;"),
    ("gl_BackColor", "gonio_BackColor", "vec4 gonio_BackColor;"),
    ("gl_TexCoord", "gonio_TexCoord", "out vec4 gonio_TexCoord[8];"),
    ("gl_FogFragCoord", "gonio_FogFragCoord", "out float gonio_FogFragCoord;"),
    ("gl_ClipVertex", "gonio_ClipVertex", "vec4 gonio_ClipVertex;"),
];

const FRAGMENT: [(&str, &str, &str); 3] = [
    ("gl_Color", "gonio_Color", "in vec4 gonio_Color;"),
    ("gl_TexCoord", "gonio_TexCoord", "in vec4 gonio_TexCoord[8];"),
    ("gl_FogFragCoord", "gonio_FogFragCoord", "in float gonio_FogFragCoord;"),
];

const BOTH: [(&str, &str, &str); 8] = [
    ("gl_ModelViewMatrix", "gonio_ModelViewMatrix", "uniform mat4 gonio_ModelViewMatrix;"),
    ("gl_ProjectionMatrix", "gonio_ProjectionMatrix", "uniform mat4 gonio_ProjectionMatrix;"),
    (
        "gl_ModelViewProjectionMatrix",
        "gonio_ModelViewProjectionMatrix",
        "uniform mat4 gonio_ModelViewProjectionMatrix;",
    ),
    ("gl_NormalMatrix", "gonio_NormalMatrix", "uniform mat3 gonio_NormalMatrix;"),
    ("gl_ModelViewMatrixInverse", "inverse(gonio_ModelViewMatrix)", "uniform mat4 gonio_ModelViewMatrix;"),
    ("gl_ModelViewMatrixTranspose", "transpose(gonio_ModelViewMatrix)", "uniform mat4 gonio_ModelViewMatrix;"),
    (
        "gl_ModelViewMatrixInverseTranspose",
        "transpose(inverse(gonio_ModelViewMatrix))",
        "uniform mat4 gonio_ModelViewMatrix;",
    ),
    ("gl_ProjectionMatrixInverse", "inverse(gonio_ProjectionMatrix)", "uniform mat4 gonio_ProjectionMatrix;"),
];

impl Translator<'_> {
    pub(super) fn legacy(&mut self) {
        let own: &[_] = if self.stage() == Stage::Vertex { &VERTEX } else { &FRAGMENT };
        let target = self.target.version();
        for (name, tokens) in &self.checked.variable_uses {
            if matches!(&**name, "gl_FragColor" | "gl_FragData") {
                continue;
            }
            if let Some((_, new, line)) = own.iter().chain(&BOTH).find(|row| row.0 == name) {
                self.replace_token(tokens.first, new);
                self.preamble.insert((*line).to_string());
                continue;
            }
            let is_there = crate::builtins::variable(name, self.stage(), target).is_some_and(|f| f.is_ok());
            if !is_there {
                let span = self.parsed.tokens[tokens.first as usize].span;
                self.cannot(span, format!("`{name}` is not available in version {}", target.written()));
            }
        }
        for (name, tokens, _) in &self.checked.function_uses {
            if name == "ftransform" {
                self.replace_token(tokens.first, "gonio_ftransform");
                self.preamble.insert("in vec4 gonio_Vertex;".into());
                self.preamble.insert("uniform mat4 gonio_ModelViewProjectionMatrix;".into());
                let line = "vec4 gonio_ftransform() { return gonio_ModelViewProjectionMatrix * gonio_Vertex; }";
                // After the declarations, in alphabetical order.
                self.preamble.insert(line.into());
            }
        }
    }
}
