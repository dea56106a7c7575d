//! All stations: their texts, parameters, pictures, plots and checks.
#![allow(clippy::unwrap_used, missing_docs)]

use gonio_beyond::{PictureRefinement, STATIONS, Station, StationFiles, page, station};
use gonio_bsdf::{ParameterKind, ParameterValues};
use gonio_image::Image;
use gonio_light::DVec3;
use gonio_plot::{PlotFigure, PlotTheme};

/// The defaults, and for each parameter both ends of its range.
fn settings(station: &Station) -> Vec<(String, ParameterValues)> {
    let mut all = vec![("defaults".to_owned(), station.defaults())];
    for parameter in station.parameters {
        for value in parameter.range() {
            let mut values = station.defaults();
            assert!(values.set_value(&parameter.name, DVec3::splat(value)));
            all.push((format!("{}={value}", parameter.name), values));
        }
    }
    all
}

fn picture(station: &Station, index: usize, values: &ParameterValues) -> Image {
    let plane = (station.pictures[index].image_plane)(values);
    let mut refined = PictureRefinement::of_pixels(plane, [40, 30], 0);
    assert!(refined.complete(1, &|_| true));
    refined.picture()
}

#[test]
fn descriptions_are_complete() {
    for (index, found) in STATIONS.iter().enumerate() {
        assert_eq!(station(found.name).map(|s| s.title), Some(found.title));
        assert!(STATIONS[..index].iter().all(|other| other.name != found.name), "{}", found.name);
        let texts = [found.assumption, found.nature, found.formula, found.source, found.look, found.question];
        assert!(texts.iter().all(|text| text.len() > 20 && !text.contains("  \n")), "{}", found.name);
        assert!(found.question.ends_with('?'), "{}", found.name);
        assert!(found.parameters.iter().any(|parameter| parameter.name == found.film_parameter), "{}", found.name);
        for parameter in found.parameters {
            assert!(!parameter.description.is_empty(), "{} {}", found.name, parameter.name);
            let text = parameter.format(parameter.default_value());
            assert_eq!(parameter.parse(&text), Ok(parameter.default_value()), "{} {}", found.name, parameter.name);
        }
        let values = found.defaults();
        let written = page(found, &values, &StationFiles::default(), &(found.checks)(&values));
        assert!(texts.iter().all(|text| written.contains(text)), "{}", found.name);
    }
    assert_eq!(station("nothing").map(|s| s.name), None);
}

/// At the defaults and at both ends of every range.
#[test]
fn laws_hold_for_all_values() {
    for station in STATIONS {
        for (label, values) in settings(station) {
            let checks = (station.checks)(&values);
            assert!(checks.len() >= 4, "{} {label}", station.name);
            for check in checks {
                assert!(check.holds(), "{} {label}: {check:?}", station.name);
            }
        }
    }
}

#[test]
fn plots_can_be_drawn_for_all_values() {
    for station in STATIONS {
        for (label, values) in settings(station) {
            let mut figure = PlotFigure::new([800, 500], PlotTheme::Light);
            (station.plot)(&values, &mut figure).unwrap_or_else(|error| panic!("{} {label}: {error}", station.name));
            assert!(!figure.shapes().is_empty());
        }
    }
}

/// Every picture shows something, is finite, and the film parameter changes the main one; every other parameter changes some
/// picture.
#[test]
fn pictures_show_something_that_each_parameter_changes() {
    for station in STATIONS {
        let plain: Vec<Image> = (0..station.pictures.len()).map(|i| picture(station, i, &station.defaults())).collect();
        for (image, picture) in plain.iter().zip(station.pictures) {
            assert!(image.pixels.iter().flatten().all(|x| x.is_finite() && *x >= 0.0), "{}", picture.name);
            let mean = image.pixels.iter().map(|p| f64::from(p[0] + p[1] + p[2])).sum::<f64>() / 3600.0;
            let shown = mean * picture.output.exposure.exp2();
            assert!((0.01..2.0).contains(&shown), "{} {}: mean {shown}", station.name, picture.name);
        }
        for parameter in station.parameters {
            let changed = |value: f64| {
                let mut values = station.defaults();
                values.set_value(&parameter.name, DVec3::splat(value));
                (0..plain.len()).map(|i| picture(station, i, &values) != plain[i]).collect::<Vec<_>>()
            };
            let ends = parameter.range().map(changed);
            let is_film = parameter.name == station.film_parameter;
            let found = ends.iter().any(|pictures| if is_film { pictures[0] } else { pictures.contains(&true) });
            assert!(found, "{} {}", station.name, parameter.name);
        }
    }
}

#[test]
fn values_beyond_the_range_are_refused_in_one_sentence() {
    for station in STATIONS {
        for parameter in station.parameters {
            let ParameterKind::Number { min, max, .. } = parameter.kind else { continue };
            for text in [format!("{}", max + 1.0), format!("{}", min - 1.0), "NaN".to_owned(), "much".to_owned()] {
                let error = station.defaults().set(&parameter.name, &text).unwrap_err().to_string();
                assert!(error.contains(&text) && error.contains(&format!("from {min} to {max}")), "{error}");
            }
        }
    }
}

#[test]
fn a_film_runs_from_one_end_to_the_other() {
    let station = station("phosphorescence").unwrap();
    assert_eq!([0, 5, 10].map(|frame| station.film_value(frame, 11)), [-2.0, 29.0, 60.0]);
    assert_eq!(station.film_value(0, 1), -2.0);
}
