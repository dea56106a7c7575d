//! A scene as TOML, and the JSON Schema of such files.

use crate::scene_file::SceneFile;
use schemars::generate::SchemaSettings;

impl SceneFile {
    /// The scene as a TOML file with a short heading. Every number is printed with as many digits as
    /// it takes to read the same number again.
    pub fn to_toml_string(&self) -> String {
        let body = match toml::to_string(self) {
            Ok(body) => body,
            // A scene has nothing that TOML lacks (checked by a test of every field); should that
            // change, the file says so where it is read.
            Err(error) => format!("# the scene could not be written: {error}\n"),
        };
        format!(
            "# A scene of gonio: `gonio render FILE.toml -o picture.png` draws it.\n\
             # Angles in degrees, lengths in world units, colours linear [r, g, b] or \"#rrggbb\" (sRGB).\n\n{body}"
        )
    }

    /// The JSON Schema of scene files, for editors.
    pub fn json_schema() -> serde_json::Value {
        let mut schema = SchemaSettings::draft07().into_generator().into_root_schema_for::<SceneFile>();
        schema.insert("title".into(), "A scene of gonio".into());
        schema.to_value()
    }
}
