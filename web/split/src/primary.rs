//! The primary half: without the moved functions, and with stubs in their slots.

use crate::plan::{Plan, function_table};
use crate::rest::Needed;
use crate::{LOAD, own_functions};
use std::collections::{BTreeMap, HashMap, HashSet};
use walrus::ir::{CallIndirect, Const, Instr, InstrSeq, ReturnCallIndirect, Value, VisitorMut, dfs_pre_order_mut};
use walrus::{ConstExpr, ElementItems, ElementKind, ExportItem, FunctionBuilder, FunctionId, FunctionKind};
use walrus::{Module, TableId, TypeId, passes};

/// Removes the moved functions and exports everything that the rest needs.
pub fn reduce(module: &mut Module, plan: &Plan, needed: &Needed) -> Result<(), String> {
    let own = own_functions(module);
    let table = function_table(module)?;
    export(module, needed)?;

    let nothing = module.types.add(&[], &[]);
    let (load, _) = module.add_import_func(LOAD.0, LOAD.1, nothing);
    let stubs: BTreeMap<u32, FunctionId> =
        plan.slots.iter().map(|(slot, n)| (*slot, stub(module, table, *slot, own[*n], Some(load)))).collect();
    put_stubs(module, plan, table, &stubs);

    let target = |module: &Module, n: &usize, slot: &u32| Target { slot: *slot, ty: module.funcs.get(own[*n]).ty() };
    let targets: HashMap<FunctionId, Target> =
        plan.slot_of.iter().map(|(n, slot)| (own[*n], target(module, n, slot))).collect();
    redirect_exports(module, table, &targets);
    let mut calls = Calls { table, targets };
    for (n, id) in own.iter().enumerate() {
        if plan.moved[n] {
            continue;
        }
        if let FunctionKind::Local(function) = &mut module.funcs.get_mut(*id).kind {
            dfs_pre_order_mut(&mut calls, function, function.entry_block());
        }
    }
    passes::gc::run(module);
    let left: HashSet<FunctionId> = module.funcs.iter().map(|function| function.id()).collect();
    match own.iter().enumerate().find(|(n, id)| plan.moved[*n] && left.contains(id)) {
        Some((n, _)) => Err(format!("function {n} was moved, but is still in use")),
        None => Ok(()),
    }
}

/// Exports everything that the rest imports.
fn export(module: &mut Module, needed: &Needed) -> Result<(), String> {
    let functions: Vec<_> = module.funcs.iter().map(|function| function.id()).collect();
    let tables: Vec<_> = module.tables.iter().map(|table| table.id()).collect();
    let memories: Vec<_> = module.memories.iter().map(|memory| memory.id()).collect();
    let globals: Vec<_> = module.globals.iter().map(|global| global.id()).collect();
    let items = (needed.functions.iter().map(|(n, name)| (name, ExportItem::Function(functions[*n]))))
        .chain(needed.tables.iter().map(|(n, name)| (name, ExportItem::Table(tables[*n]))))
        .chain(needed.memories.iter().map(|(n, name)| (name, ExportItem::Memory(memories[*n]))))
        .chain(needed.globals.iter().map(|(n, name)| (name, ExportItem::Global(globals[*n]))));
    for (name, item) in items {
        if module.exports.iter().any(|export| export.name == *name) {
            return Err(format!("the module exports `{name}`, a name that the halves need for themselves"));
        }
        module.exports.add(name, item);
    }
    Ok(())
}

/// Makes a function with the parameters and results of another that calls through a slot; with `load`, it calls that first.
fn stub(module: &mut Module, table: TableId, slot: u32, of: FunctionId, load: Option<FunctionId>) -> FunctionId {
    let ty = module.funcs.get(of).ty();
    let (parameters, results) = module.types.params_results(ty);
    let (parameters, results) = (parameters.to_vec(), results.to_vec());
    let arguments: Vec<_> = parameters.iter().map(|ty| module.locals.add(*ty)).collect();
    let mut builder = FunctionBuilder::new(&mut module.types, &parameters, &results);
    let mut body = builder.func_body();
    if let Some(load) = load {
        body.call(load);
    }
    for argument in &arguments {
        body.local_get(*argument);
    }
    body.i32_const(slot as i32).call_indirect(ty, table);
    builder.finish(arguments, &mut module.funcs)
}

/// Replaces the moved functions in the table with their stubs, and adds slots for the others.
fn put_stubs(module: &mut Module, plan: &Plan, table: TableId, stubs: &BTreeMap<u32, FunctionId>) {
    for element in module.elements.iter_mut() {
        let ElementKind::Active { table: into, offset: ConstExpr::Value(Value::I32(offset)) } = element.kind else {
            continue;
        };
        if into != table {
            continue;
        }
        match &mut element.items {
            ElementItems::Functions(ids) => {
                for (id, slot) in ids.iter_mut().zip(offset as u32..) {
                    *id = stubs.get(&slot).copied().unwrap_or(*id);
                }
            }
            ElementItems::Expressions(_, expressions) => {
                for (expression, slot) in expressions.iter_mut().zip(offset as u32..) {
                    if let Some(stub) = stubs.get(&slot) {
                        *expression = ConstExpr::RefFunc(*stub);
                    }
                }
            }
        }
    }
    let (before, _) = plan.table_sizes;
    let added: Vec<FunctionId> = stubs.range(before..).map(|(_, stub)| *stub).collect();
    let kind = ElementKind::Active { table, offset: ConstExpr::Value(Value::I32(before as i32)) };
    let element = module.elements.add(kind, ElementItems::Functions(added));
    let table = module.tables.get_mut(table);
    table.elem_segments.insert(element);
    plan.resize(table);
}

/// Makes the exports of moved functions call through their slots, so that they stay valid when the rest is loaded.
fn redirect_exports(module: &mut Module, table: TableId, targets: &HashMap<FunctionId, Target>) {
    let exports = module.exports.iter().filter_map(|export| match export.item {
        ExportItem::Function(id) => Some((export.id(), id, targets.get(&id)?.slot)),
        _ => None,
    });
    for (export, id, slot) in exports.collect::<Vec<_>>() {
        module.exports.get_mut(export).item = ExportItem::Function(stub(module, table, slot, id, None));
    }
}

/// The call of a moved function.
struct Target {
    slot: u32,
    ty: TypeId,
}

/// Replaces calls of moved functions with calls through their slots.
struct Calls {
    table: TableId,
    targets: HashMap<FunctionId, Target>,
}

impl VisitorMut for Calls {
    fn start_instr_seq_mut(&mut self, seq: &mut InstrSeq) {
        let target = |instr: &Instr| match instr {
            Instr::Call(call) => self.targets.get(&call.func),
            Instr::ReturnCall(call) => self.targets.get(&call.func),
            _ => None,
        };
        if !seq.instrs.iter().any(|(instr, _)| target(instr).is_some()) {
            return;
        }
        let before = std::mem::take(&mut seq.instrs);
        for (instr, place) in before {
            let Some(Target { slot, ty }) = target(&instr) else {
                seq.instrs.push((instr, place));
                continue;
            };
            let (ty, table) = (*ty, self.table);
            let call = match instr {
                Instr::ReturnCall(_) => Instr::ReturnCallIndirect(ReturnCallIndirect { ty, table }),
                _ => Instr::CallIndirect(CallIndirect { ty, table }),
            };
            seq.instrs.push((Instr::Const(Const { value: Value::I32(*slot as i32) }), place));
            seq.instrs.push((call, place));
        }
    }
}
