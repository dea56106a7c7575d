//! Right values of a cause at any points, not only those of the test scenes.

use super::model::{Model, Quantity, Space, observe};
use super::observed::Observed;
use super::program::{Change, Runner};
use super::repair::{Make, Repair};
use super::values::Values;
use gonio_glsl::Stage;
use gonio_interpreter::ExprId;

/// A right quantity, apart from its values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct QuantityName {
    pub(super) name: String,
    pub(super) space: Space,
    pub(super) interpolated: bool,
}

impl QuantityName {
    pub(super) fn new(quantity: &Quantity) -> Self {
        let Quantity { name, space, interpolated, .. } = quantity;
        QuantityName { name: name.clone(), space: *space, interpolated: *interpolated }
    }

    /// Its index in a model.
    pub(super) fn index(&self, stage: Stage, model: &Model) -> Option<usize> {
        let is_it = |q: &Quantity| q.stage == stage && q.mistake.is_none() && QuantityName::new(q) == *self;
        model.quantities.iter().position(is_it)
    }
}

/// How the right values of an expression are made, at any points.
#[derive(Clone, Debug, PartialEq)]
enum RightMake {
    Quantity(QuantityName),
    Times(QuantityName),
    Over(QuantityName),
    /// Plus the value of another expression, in one of its evaluations.
    Plus(ExprId, Option<u32>),
    /// From the own values alone.
    Own(Make),
}

/// The right values of a cause, at any points.
#[derive(Clone, Debug, PartialEq)]
pub struct RightChange {
    pub(super) stage: Stage,
    pub(super) expr: ExprId,
    pub(super) occurrence: Option<u32>,
    make: RightMake,
}

impl RightChange {
    pub(super) fn new(repair: &Repair, observed: &[Observed], model: &Model) -> Self {
        let seen = &observed[repair.of];
        let name = |index: usize| QuantityName::new(&model.quantities[index]);
        let make = match repair.make {
            Make::Quantity(index) => RightMake::Quantity(name(index)),
            Make::Times(index) => RightMake::Times(name(index)),
            Make::Over(index) => RightMake::Over(name(index)),
            Make::Plus(other) => RightMake::Plus(observed[other].expr, observed[other].occurrence),
            own @ (Make::Negative | Make::Unit | Make::NotNegative | Make::Linear) => RightMake::Own(own),
        };
        RightChange { stage: seen.stage, expr: seen.expr, occurrence: seen.occurrence, make }
    }

    /// The change at the points of a runner; `None` if the values are right there.
    pub(super) fn change(&self, runner: &Runner<'_>, model: &Model, before: &[Change]) -> Option<Change> {
        let mut watched = vec![(self.expr, self.occurrence)];
        if let RightMake::Plus(expr, occurrence) = self.make {
            watched.push((expr, occurrence));
        }
        let observed: Option<Vec<Observed>> =
            watched.into_iter().map(|(expr, occurrence)| self.observed(runner, before, expr, occurrence)).collect();
        let index = |name: &QuantityName| name.index(self.stage, model);
        let make = match &self.make {
            RightMake::Quantity(name) => Make::Quantity(index(name)?),
            RightMake::Times(name) => Make::Times(index(name)?),
            RightMake::Over(name) => Make::Over(index(name)?),
            RightMake::Plus(..) => Make::Plus(1),
            RightMake::Own(make) => *make,
        };
        let relation = super::repair::Relation::Other;
        Repair { of: 0, relation, should: String::new(), make, cost: 0.0 }.change(&observed?, model)
    }

    fn observed(
        &self,
        runner: &Runner<'_>,
        before: &[Change],
        expr: ExprId,
        occurrence: Option<u32>,
    ) -> Option<Observed> {
        let values = values_of(runner, before, self.stage, expr, occurrence)?;
        let Self { stage, .. } = *self;
        Some(Observed { stage, expr, occurrence, values, is: None, is_assignment: false, defined_at: None, depth: 0 })
    }
}

/// The values of an expression in one of its evaluations, or in the last of each point.
pub(super) fn values_of(
    runner: &Runner<'_>,
    changes: &[Change],
    stage: Stage,
    expr: ExprId,
    occurrence: Option<u32>,
) -> Option<Values> {
    let (only, none) = ([expr], []);
    let watched: [&[ExprId]; 2] = if stage == Stage::Vertex { [&only, &none] } else { [&none, &only] };
    let all = observe(runner, changes, 0..runner.samples.len(), watched);
    let wanted = all.into_iter().filter(|found| occurrence.is_none_or(|wanted| wanted == found.occurrence));
    wanted.map(|found| found.values).reduce(|mut last, next| {
        for point in (0..next.points()).filter(|point| next.present[*point]) {
            last.present[point] = true;
            let at = point * next.size..(point + 1) * next.size;
            last.numbers[at.clone()].copy_from_slice(&next.numbers[at]);
        }
        last
    })
}
