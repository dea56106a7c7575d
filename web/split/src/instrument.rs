//! Instruments a module to record which of its functions run.

use crate::{own_functions, parse};
use walrus::ir::{BinaryOp, Value};
use walrus::{ConstExpr, FunctionKind, Module, ValType};

/// Adds to a module:
/// - `ran:functions`, a constant i32: the number of its own functions;
/// - `ran:0`, `ran:1` and so on, i32 each: bit `b` of the `n`-th is set when function `32 n + b` is entered.
///
/// These are globals because only the module's allocator knows which memory is free.
pub fn instrument(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let mut module = parse(bytes)?;
    let functions = own_functions(&module);
    let count = global(&mut module, functions.len() as i32, false);
    module.exports.add("ran:functions", count);
    for (index, group) in functions.chunks(32).enumerate() {
        let ran = global(&mut module, 0, true);
        module.exports.add(&format!("ran:{index}"), ran);
        for (bit, id) in group.iter().enumerate() {
            let FunctionKind::Local(function) = &mut module.funcs.get_mut(*id).kind else { continue };
            function
                .builder_mut()
                .func_body()
                .global_get_at(0, ran)
                .const_at(1, Value::I32(1 << bit))
                .binop_at(2, BinaryOp::I32Or)
                .global_set_at(3, ran);
        }
    }
    Ok(module.emit_wasm())
}

fn global(module: &mut Module, value: i32, mutable: bool) -> walrus::GlobalId {
    module.globals.add_local(ValType::I32, mutable, false, ConstExpr::Value(Value::I32(value)))
}
