//! The rest: the moved functions, with everything else imported.

use crate::plan::{Plan, function_table};
use crate::{PRIMARY, own_functions};
use walrus::ir::Value;
use walrus::{
    ConstExpr, ElementItems, ElementKind, FunctionId, FunctionKind, GlobalKind, ImportKind, ImportedFunction,
};
use walrus::{Module, passes};

/// The imports of the rest, each with the name under which the primary half must export it. They are numbered as in the module
/// before the split: each kind from 0, imports before the module's own.
#[derive(Default)]
pub struct Needed {
    pub functions: Vec<(usize, String)>,
    pub tables: Vec<(usize, String)>,
    pub memories: Vec<(usize, String)>,
    pub globals: Vec<(usize, String)>,
}

/// Removes everything that the primary half keeps.
pub fn reduce(module: &mut Module, plan: &Plan) -> Result<Needed, String> {
    let own = own_functions(module);
    let functions: Vec<FunctionId> = module.funcs.iter().map(|function| function.id()).collect();
    let tables: Vec<_> = module.tables.iter().map(|table| table.id()).collect();
    let memories: Vec<_> = module.memories.iter().map(|memory| memory.id()).collect();
    let globals: Vec<_> = module.globals.iter().map(|global| global.id()).collect();

    clear(module);
    let imported = functions.len() - own.len();
    for (n, id) in functions.iter().enumerate() {
        if n >= imported && plan.moved[n - imported] {
            continue;
        }
        let import = module.imports.add(PRIMARY, &n.to_string(), ImportKind::Function(*id));
        let function = module.funcs.get_mut(*id);
        function.kind = FunctionKind::Import(ImportedFunction { import, ty: function.ty() });
    }
    for (n, id) in tables.iter().enumerate() {
        let import = module.imports.add(PRIMARY, &n.to_string(), ImportKind::Table(*id));
        module.tables.get_mut(*id).import = Some(import);
    }
    for (n, id) in memories.iter().enumerate() {
        let import = module.imports.add(PRIMARY, &n.to_string(), ImportKind::Memory(*id));
        module.memories.get_mut(*id).import = Some(import);
    }
    for (n, id) in globals.iter().enumerate() {
        let import = module.imports.add(PRIMARY, &n.to_string(), ImportKind::Global(*id));
        module.globals.get_mut(*id).kind = GlobalKind::Import(import);
    }
    fill_slots(module, plan, &own)?;
    passes::gc::run(module);
    name_imports(module)
}

/// Removes state and entry points, which belong to the primary half.
fn clear(module: &mut Module) {
    module.start = None;
    for id in module.exports.iter().map(|export| export.id()).collect::<Vec<_>>() {
        module.exports.delete(id);
    }
    for id in module.imports.iter().map(|import| import.id()).collect::<Vec<_>>() {
        module.imports.delete(id);
    }
    for memory in module.memories.iter_mut() {
        memory.data_segments.clear();
    }
    for id in module.data.iter().map(|data| data.id()).collect::<Vec<_>>() {
        module.data.delete(id);
    }
    for table in module.tables.iter_mut() {
        table.elem_segments.clear();
    }
    for id in module.elements.iter().map(|element| element.id()).collect::<Vec<_>>() {
        module.elements.delete(id);
    }
    // Custom sections of other tools describe the whole module. Without `target_features`, wasm-opt misreads the module.
    let custom_sections = module.customs.iter().filter(|(_, section)| section.name() != "target_features");
    for id in custom_sections.map(|(id, _)| id).collect::<Vec<_>>() {
        module.customs.delete(id);
    }
}

/// Replaces the stubs with the moved functions when the rest is instantiated.
fn fill_slots(module: &mut Module, plan: &Plan, own: &[FunctionId]) -> Result<(), String> {
    let table = function_table(module)?;
    plan.resize(module.tables.get_mut(table));
    let mut runs: Vec<(u32, Vec<FunctionId>)> = Vec::new();
    for (slot, n) in &plan.slots {
        match runs.last_mut() {
            Some((start, run)) if *start + run.len() as u32 == *slot => run.push(own[*n]),
            _ => runs.push((*slot, vec![own[*n]])),
        }
    }
    for (start, run) in runs {
        let kind = ElementKind::Active { table, offset: ConstExpr::Value(Value::I32(start as i32)) };
        let element = module.elements.add(kind, ElementItems::Functions(run));
        module.tables.get_mut(table).elem_segments.insert(element);
    }
    Ok(())
}

/// Gives each remaining import a short name of its own.
fn name_imports(module: &mut Module) -> Result<Needed, String> {
    let mut needed = Needed::default();
    for (count, import) in module.imports.iter_mut().enumerate() {
        let n = import.name.parse::<usize>().map_err(|e| format!("an import is called {}: {e}", import.name))?;
        let kind = match import.kind {
            ImportKind::Function(_) => &mut needed.functions,
            ImportKind::Table(_) => &mut needed.tables,
            ImportKind::Memory(_) => &mut needed.memories,
            ImportKind::Global(_) => &mut needed.globals,
            ImportKind::Tag(_) => return Err("tags are not split".to_owned()),
        };
        import.name = short_name(count);
        kind.push((n, import.name.clone()));
    }
    Ok(needed)
}

/// `0` to `9`, `a` to `z`, then two of them, and so on.
fn short_name(mut number: usize) -> String {
    let mut name = Vec::new();
    loop {
        name.insert(0, b"0123456789abcdefghijklmnopqrstuvwxyz"[number % 36]);
        number /= 36;
        if number == 0 {
            return String::from_utf8_lossy(&name).into_owned();
        }
        number -= 1;
    }
}
