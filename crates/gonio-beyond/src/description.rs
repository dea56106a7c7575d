//! A station's texts and parameters as data, for a window whose stations are computed elsewhere: in a thread or a worker.

use crate::station::Station;
use gonio_bsdf::Parameter;
use serde::{Deserialize, Serialize};

/// Everything that a window shows of a station except what is computed. The fields are those of [`Station`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StationDescription {
    /// The name on the command line and in links.
    pub name: String,
    /// The heading.
    pub title: String,
    /// The part of the rendering equation that excludes the phenomenon.
    pub assumption: String,
    /// The phenomenon in nature.
    pub nature: String,
    /// The law, one formula a line.
    pub formula: String,
    /// Author, year and place of the law.
    pub source: String,
    /// Where to look in the pictures.
    pub look: String,
    /// A question to the reader.
    pub question: String,
    /// The parameters.
    pub parameters: Vec<Parameter>,
    /// The name of the parameter that a film changes.
    pub film_parameter: String,
    /// Name and caption of each picture, the main one first.
    pub pictures: Vec<(String, String)>,
}

impl From<&Station> for StationDescription {
    fn from(station: &Station) -> Self {
        let text = str::to_owned;
        Self {
            name: text(station.name),
            title: text(station.title),
            assumption: text(station.assumption),
            nature: text(station.nature),
            formula: text(station.formula),
            source: text(station.source),
            look: text(station.look),
            question: text(station.question),
            parameters: station.parameters.to_vec(),
            film_parameter: text(station.film_parameter),
            pictures: station.pictures.iter().map(|picture| (text(picture.name), text(picture.caption))).collect(),
        }
    }
}
