//! The models on the CPU against the same models drawn by the driver.

#![allow(clippy::unwrap_used)]

use super::compare::Comparison;
use super::on_cpu::{Canvases, Detail};
use super::parameterisation::{Freedom, Lights};
use super::predict::CompiledModel;
use super::task::Task;
use crate::roles::Bindings;
use crate::rules::Written;
use crate::testbench::Stage;
use gonio_gl::HeadlessContext;

/// The share of pixels that may differ: half of what a verdict allows. Set by rounding, at the edge of what counts as a difference.
const MOST_BEYOND: f64 = 0.005;

#[test]
fn every_hypothesis_is_on_the_cpu_what_the_driver_draws() {
    let context = HeadlessContext::new().unwrap_or_else(|why| panic!("{why}"));
    let mut tried = 0;
    for exercise in ["ex05", "ex07"] {
        let task = Task::of(exercise).unwrap();
        let (situations, [whole, _]) = task.situations();
        let stage = Stage::new(context.gl(), situations).unwrap();
        // Nothing is given from outside: every strength has to be found.
        let freedom = Freedom::of(task, &Bindings::default(), &Bindings::default(), &Written::default());
        for model in [Some(task.model), task.other.map(|(model, _)| model)].into_iter().flatten() {
            let compiled = CompiledModel::new(context.gl(), model);
            let cast = compiled.cast(&freedom, Lights::One);
            for hypothesis in compiled.hypotheses.singles.iter().step_by(3) {
                let black = crate::testbench::Sheet { pixels: vec![[0.5, 0.25, 0.125, 1.0]; whole * 1024] };
                let driver = compiled.predict(&stage, &cast, &black, hypothesis, whole).unwrap();
                let canvases = Canvases::new(&stage, &compiled, &cast, &driver.sheet, whole).unwrap();
                let (rest, _) = canvases.compare(hypothesis, Detail::Full).unwrap();
                let id = &compiled.hypotheses.mistakes[hypothesis.made_of[0]].id;
                let worst = rest.beyond.iter().copied().fold(0.0, f64::max);
                assert!(rest.is_same() && worst <= MOST_BEYOND, "{exercise} {model:?} {id}: {rest:?}");
                let plain = compiled.predict(&stage, &cast, &black, &Default::default(), whole).unwrap();
                let shows = !Comparison::of(&plain.sheet, &driver.sheet, whole).is_same();
                tried += usize::from(shows);
            }
        }
    }
    assert!(tried >= 40, "{tried}");
}
