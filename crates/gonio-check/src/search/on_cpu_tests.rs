//! The models on the CPU against the same models drawn by the driver.

#![allow(clippy::unwrap_used)]

use super::compare::Comparison;
use super::on_cpu::{CpuComparer, Detail};
use super::parameterisation::{Lights, Parameterisation};
use super::predict::CompiledModel;
use super::task::Task;
use crate::roles::Bindings;
use crate::rules::Written;
use crate::testbench::Testbench;
use gonio_gl::HeadlessContext;

/// The share of pixels that may differ: half of what a verdict allows. Set by rounding, at the edge of what counts as a difference.
const MOST_BEYOND: f64 = 0.005;

#[test]
fn every_hypothesis_is_on_the_cpu_what_the_driver_draws() {
    let context = HeadlessContext::new().unwrap_or_else(|why| panic!("{why}"));
    let mut tried = 0;
    for exercise in ["ex05", "ex07"] {
        let task = Task::find(exercise).unwrap();
        let (test_scenes, [whole, _]) = task.test_scenes();
        let testbench = Testbench::new(context.gl(), test_scenes).unwrap();
        // Nothing is given from outside: every strength has to be found.
        let parameterisation =
            Parameterisation::new(task, &Bindings::default(), &Bindings::default(), &Written::default());
        for model in [Some(task.model), task.other.map(|(model, _)| model)].into_iter().flatten() {
            let compiled = CompiledModel::new(context.gl(), model);
            let inputs = compiled.inputs(&parameterisation, Lights::One);
            for hypothesis in compiled.hypotheses.singles.iter().step_by(3) {
                let black = crate::testbench::Atlas { pixels: vec![[0.5, 0.25, 0.125, 1.0]; whole * 1024] };
                let driver = compiled.predict(&testbench, &inputs, &black, hypothesis, whole).unwrap();
                let comparers = CpuComparer::new(&testbench, &compiled, &inputs, &driver.atlas, whole).unwrap();
                let (residual, _) = comparers.compare(hypothesis, Detail::Full).unwrap();
                let id = &compiled.hypotheses.mistakes[hypothesis.mistakes[0]].id;
                let worst = residual.beyond.iter().copied().fold(0.0, f64::max);
                assert!(residual.is_same() && worst <= MOST_BEYOND, "{exercise} {model:?} {id}: {residual:?}");
                let plain = compiled.predict(&testbench, &inputs, &black, &Default::default(), whole).unwrap();
                let shows = !Comparison::new(&plain.atlas, &driver.atlas, whole).is_same();
                tried += usize::from(shows);
            }
        }
    }
    assert!(tried >= 40, "{tried}");
}
