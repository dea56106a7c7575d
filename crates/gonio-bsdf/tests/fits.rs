//! Fits recover the parameters of tables made from known models.
#![allow(clippy::unwrap_used)]

use gonio_bsdf::fit_file;
use gonio_bsdf::merl::{CELLS, SCALES};
use gonio_bsdf::sampling::{SplitMix, direction};
use gonio_bsdf::{Bsdf, FitError, FitResidual, MerlTable, ModelSpec, NamedBsdf, fit};

fn table(spec: &str) -> MerlTable {
    MerlTable::tabulate(ModelSpec::parse(spec).unwrap().build().as_ref()).unwrap()
}

/// The same with a normally distributed error of 5 % in every value.
fn noisy(table: &MerlTable) -> MerlTable {
    let mut random = SplitMix::new(5);
    let mut bytes = table.write();
    for eight in bytes[12..].as_chunks_mut::<8>().0 {
        let value = f64::from_le_bytes(*eight);
        if value >= 0.0 {
            *eight = (value * (1.0 + 0.05 * random.next_normal())).to_le_bytes();
        }
    }
    MerlTable::read(&bytes).unwrap()
}

/// The same function with the lobes of `lafortune-2` and `-3` in the order of their exponents.
fn in_order(spec: &ModelSpec) -> ModelSpec {
    let mut ordered = spec.clone();
    let count = spec.model.name.strip_prefix("lafortune-").and_then(|count| count.parse().ok()).unwrap_or(0);
    let mut lobes: Vec<usize> = (1..=count).collect();
    lobes.sort_by(|a, b| spec.values.number(&format!("k{a}")).total_cmp(&spec.values.number(&format!("k{b}"))));
    for (to, from) in (1..).zip(lobes) {
        for name in ["b", "k", "z"] {
            ordered.values.set_value(&format!("{name}{to}"), spec.values.color(&format!("{name}{from}")));
        }
    }
    ordered
}

/// Fits `model` to a table of `truth` and compares every parameter.
#[track_caller]
fn recovers(truth: &str, table: &MerlTable, tolerance: f64) {
    let truth = ModelSpec::parse(truth).unwrap();
    let found = fit(table, &ModelSpec::new(truth.model)).unwrap();
    let found = in_order(&found.spec);
    for ((parameter, expected), (_, found)) in truth.values.iter().zip(found.values.iter()) {
        // Relative, and for colours near black relative to 1 %.
        let scale = expected.abs().max_element().max(0.01);
        let error = (found - expected).abs().max_element() / scale;
        assert!(error < tolerance, "{} of {}: {found}, not {expected}", parameter.name, truth.text());
    }
}

#[test]
fn parameters_are_recovered() {
    // Issue 19 set 2 %.
    for truth in [
        "lambert:a=0.5/0.3/0.1",
        "phong:a=0.2/0.1/0.05,b=0.6,c=40",
        "phong-normalised:a=0.1,b=0.3/0.2/0.1,c=12",
        "blinn:a=0.3,b=0.5,c=100",
        "blinn-normalised:a=0.05,b=0.2,c=25",
        "lafortune-normalised:a=0.1,b=0.4,k=20,az=-0.8",
        "lafortune-2:a=0.1,b1=0.3/0.2/0.1,k1=8,z1=-0.9,b2=0.2,k2=120,z2=-1.1",
        "lafortune-3:a=0.05,b1=0.2/0.3/0.2,k1=5,z1=-0.8,b2=0.15,k2=40,z2=-1,b3=0.1,k3=300,z3=-1.05",
        "ward:a=0.2/0.3/0.4,b=0.3/0.2/0.1,c=0.2",
        "ward-normalised:a=0.1,b=0.4,c=0.3",
        "cook-torrance:a=0.1,f0=0.5/0.4/0.2,m=0.35",
        "beckmann:a=0.1,f0=0.9/0.6/0.3,alpha=0.25",
        "ggx:a=0.2/0.1/0.05,f0=0.04,alpha=0.15",
        "ggx:f0=0.95/0.64/0.54,alpha=0.4",
        "oren-nayar:a=0.6/0.5/0.4,sigma=35",
        "ashikhmin-shirley:rd=0.4/0.2/0.1,rs=0.1,nu=80,nv=80",
        "disney:baseColor=0.6/0.4/0.2,metallic=0.3,roughness=0.4,specular=0.7",
    ] {
        recovers(truth, &table(truth), 0.02);
    }
}

#[test]
fn parameters_are_recovered_from_noise() {
    // Issue 19 set 5 %, with 5 % noise.
    for truth in
        ["ward:a=0.2/0.3/0.4,b=0.3/0.2/0.1,c=0.2", "ggx:a=0.2/0.1/0.05,f0=0.04,alpha=0.15", "blinn:a=0.3,b=0.5,c=100"]
    {
        recovers(truth, &noisy(&table(truth)), 0.05);
    }
}

#[test]
fn the_wrong_model_fits_worse() {
    let measured = table("ggx:a=0.1,f0=0.8,alpha=0.3");
    let error = |model: &str| fit(&measured, &ModelSpec::parse(model).unwrap()).unwrap().rms;
    let (ggx, beckmann, lambert) = (error("ggx"), error("beckmann"), error("lambert"));
    // The residual of the wrong model is the difference at every direction.
    let lambert_fit = fit(&measured, &ModelSpec::parse("lambert").unwrap()).unwrap().spec.build();
    let residual = FitResidual { table: &measured, fitted: lambert_fit.as_ref() };
    let (wi, wo) = (direction(0.5, 0.0), direction(0.5, std::f64::consts::PI));
    let expected = measured.evaluate(wi, wo) - lambert_fit.evaluate(wi, wo);
    assert!(expected.x > 0.1 && residual.evaluate(wi, wo) == expected, "{expected}");
    assert!(ggx < 1e-3 && beckmann > 10.0 * ggx && lambert > 2.0 * beckmann, "{ggx} {beckmann} {lambert}");
}

#[test]
fn impossible_fits_are_refused() {
    let spec = |text: &str| ModelSpec::parse(text).unwrap();
    let error = fit(&table("lambert"), &spec("ward-anisotropic")).unwrap_err();
    assert!(
        error.to_string().starts_with("an isotropic table does not determine the parameters of `ward-anisotropic`: ")
    );
    // All values missing but for one cell.
    let mut bytes = table("lambert").write();
    for (index, eight) in bytes[12..].as_chunks_mut::<8>().0.iter_mut().enumerate() {
        *eight = (if index % CELLS == 5 { 1.0 / SCALES[0] } else { -1.0_f64 }).to_le_bytes();
    }
    let sparse = MerlTable::read(&bytes).unwrap();
    assert!(matches!(fit(&sparse, &spec("ward")), Err(FitError::TooFewValues { .. })));
}

#[test]
fn fits_are_read_as_models() {
    let measured = table("ward:a=0.2/0.3/0.4,b=0.3/0.2/0.1,c=0.2");
    let fits = ["ward", "lambert"].map(|model| fit(&measured, &ModelSpec::parse(model).unwrap()).unwrap());
    let text = fit_file::write(&fits);
    let read = fit_file::read(&text).unwrap();
    assert_eq!((read[0].model.name, read[1].model.name), ("ward", "lambert"));
    assert_eq!(read[0].values, fits[0].spec.values);
    let named = NamedBsdf::of_file("fit.toml", text.as_bytes(), "c=0.5").unwrap();
    assert_eq!((named.name.as_str(), named.values.number("c")), ("fit.toml: ward", 0.5));
    let error = |text: &str| NamedBsdf::of_file("fit.toml", text.as_bytes(), "").unwrap_err().to_string();
    assert_eq!(error("fit = []"), "the file has no `[[fit]]`");
    assert!(error("[[fit]]\nmodel = 1\n").starts_with("2:9: "), "{}", error("[[fit]]\nmodel = 1\n"));
    assert!(error("[[fit]]\nmodel = 'wart'\nparameters = {}").starts_with("unknown model `wart`"));
    assert!(error("[[fit]]\nmodel = 'ward'\nparameters = { c = 5 }").starts_with("invalid value `5` of parameter `c`"));
}
