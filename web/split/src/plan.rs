//! The plan of a split: the half of each function, and the slots of the table through which the halves call each other.

use crate::own_functions;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use walrus::ir::{Call, RefFunc, ReturnCall, Value, Visitor, dfs_in_order};
use walrus::{
    ConstExpr, DataId, ElementId, ElementItems, ElementKind, ExportItem, FunctionId, GlobalKind, Module, Table, TableId,
};

/// The plan of a split. The module's own functions are numbered from 0, in the order of the file.
pub struct Plan {
    /// The functions that go into the rest.
    pub moved: Vec<bool>,
    /// Each slot of the function table that contains a moved function, and that function.
    pub slots: BTreeMap<u32, usize>,
    /// The slot of each moved function that the primary half calls.
    pub slot_of: BTreeMap<usize, u32>,
    /// Number of slots of the table before and after.
    pub table_sizes: (u32, u32),
}

impl Plan {
    /// `ran`: see [`crate::split`].
    pub fn new(module: &Module, ran: &str) -> Result<Plan, String> {
        let functions = own_functions(module);
        if ran.len() != functions.len() || ran.bytes().any(|byte| byte != b'0' && byte != b'1') {
            let (has, wants) = (ran.len(), functions.len());
            return Err(format!("the profile has {has} characters; expected a 0 or 1 for each of {wants} functions"));
        }
        if module.tags.iter().next().is_some() {
            return Err("the module throws exceptions, which are not supported".to_owned());
        }
        let number: HashMap<FunctionId, usize> = functions.iter().enumerate().map(|(n, id)| (*id, n)).collect();
        let bodies: Vec<Body> = functions.iter().map(|id| Body::of(module, *id)).collect();

        let mut moved: Vec<bool> = ran.bytes().map(|byte| byte == b'0').collect();
        for (n, body) in bodies.iter().enumerate() {
            // A stub would be as large as a small function.
            moved[n] &= !body.bound && body.size > SMALL;
        }
        for (n, id) in functions.iter().enumerate() {
            let name = module.funcs.get(*id).name.as_deref().unwrap_or_default();
            moved[n] &= !BY_CHANCE.iter().any(|part| name.contains(part));
        }
        for id in held_elsewhere(module).iter().chain(bodies.iter().flat_map(|body| &body.referred)) {
            if let Some(n) = number.get(id) {
                moved[*n] = false;
            }
        }

        let table = function_table(module)?;
        let mut slots = BTreeMap::new();
        for (slot, id) in entries(module, table)? {
            if let Some(n) = number.get(&id).filter(|n| moved[**n]) {
                slots.insert(slot, *n);
            }
        }
        let mut slot_of: BTreeMap<usize, u32> = slots.iter().map(|(slot, n)| (*n, *slot)).collect();

        let exported = module.exports.iter().filter_map(|export| match export.item {
            ExportItem::Function(id) => Some(id),
            _ => None,
        });
        let kept = bodies.iter().enumerate().filter(|(n, _)| !moved[*n]).map(|(_, body)| body);
        let called: BTreeSet<usize> = kept
            .flat_map(|body| body.called.iter().copied())
            .chain(exported)
            .filter_map(|id| number.get(&id).copied())
            .filter(|n| moved[*n])
            .collect();
        let size = u32::try_from(module.tables.get(table).initial)
            .map_err(|_| "the function table is larger than 32 bits".to_owned())?;
        let mut end = size;
        for n in called {
            slot_of.entry(n).or_insert_with(|| {
                slots.insert(end, n);
                end += 1;
                end - 1
            });
        }
        Ok(Plan { moved, slots, slot_of, table_sizes: (size, end) })
    }

    /// Enlarges the function table for the added slots.
    pub fn resize(&self, table: &mut Table) {
        let (before, after) = self.table_sizes;
        table.initial = u64::from(after);
        table.maximum = table.maximum.map(|most| most + u64::from(after - before));
    }
}

/// Parts of the names of functions that run or not by chance: hash tables ordered by addresses, growing lists, digits of measured
/// numbers. These functions stay in the primary half, whether they ran or not.
const BY_CHANCE: [&str; 5] =
    ["hashbrown::", "std::collections::hash", "std::path::", "alloc::raw_vec", "core::num::flt2dec"];

/// Size in instructions: a stub has three, and one for each parameter.
const SMALL: u64 = 3;

/// The module's one table of functions.
pub fn function_table(module: &Module) -> Result<TableId, String> {
    let table = module.tables.main_function_table().map_err(|e| format!("{e:#}"))?;
    table.ok_or_else(|| "the module has no table of functions".to_owned())
}

/// The relations of a function to others.
#[derive(Default)]
struct Body {
    /// In instructions.
    size: u64,
    called: Vec<FunctionId>,
    /// Functions whose reference it takes, which are not replaced.
    referred: Vec<FunctionId>,
    /// Whether it uses segments of data or elements, which exist in one half only.
    bound: bool,
}

impl Body {
    fn of(module: &Module, id: FunctionId) -> Body {
        let mut body = Body::default();
        if let walrus::FunctionKind::Local(function) = &module.funcs.get(id).kind {
            body.size = function.size();
            dfs_in_order(&mut body, function, function.entry_block());
        }
        body
    }
}

impl<'a> Visitor<'a> for Body {
    fn visit_call(&mut self, call: &Call) {
        self.called.push(call.func);
    }

    fn visit_return_call(&mut self, call: &ReturnCall) {
        self.called.push(call.func);
    }

    fn visit_ref_func(&mut self, reference: &RefFunc) {
        self.referred.push(reference.func);
    }

    fn visit_data_id(&mut self, _: &DataId) {
        self.bound = true;
    }

    fn visit_element_id(&mut self, _: &ElementId) {
        self.bound = true;
    }
}

/// Functions that no stub can replace: the start function, and those in globals or in passive segments.
fn held_elsewhere(module: &Module) -> Vec<FunctionId> {
    let globals = module.globals.iter().filter_map(|global| match global.kind {
        GlobalKind::Local(ConstExpr::RefFunc(id)) => Some(id),
        _ => None,
    });
    let passive = module.elements.iter().filter(|e| !matches!(e.kind, ElementKind::Active { .. }));
    let passive = passive.flat_map(|element| functions(&element.items).into_iter().flatten());
    module.start.into_iter().chain(globals).chain(passive).collect()
}

/// The function of each entry of a segment; `None` for empty entries.
fn functions(items: &ElementItems) -> Vec<Option<FunctionId>> {
    match items {
        ElementItems::Functions(ids) => ids.iter().copied().map(Some).collect(),
        ElementItems::Expressions(_, expressions) => expressions
            .iter()
            .map(|expression| if let ConstExpr::RefFunc(id) = expression { Some(*id) } else { None })
            .collect(),
    }
}

/// The functions in a table, by their slots.
fn entries(module: &Module, table: TableId) -> Result<BTreeMap<u32, FunctionId>, String> {
    let mut entries = BTreeMap::new();
    for element in module.elements.iter() {
        let ElementKind::Active { table: into, offset } = &element.kind else { continue };
        if *into != table {
            continue;
        }
        let ConstExpr::Value(Value::I32(offset)) = offset else {
            return Err("a segment of the function table has no fixed place".to_owned());
        };
        for (id, slot) in functions(&element.items).into_iter().zip(*offset as u32..) {
            if id.is_some_and(|id| entries.insert(slot, id).is_some()) {
                return Err(format!("the function table's slot {slot} is filled twice"));
            }
        }
    }
    Ok(entries)
}
