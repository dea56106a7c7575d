//! Checks constructors: `vec4(position, 1.0)` (GLSL 4.60, section 5.4).

use super::Checker;
use crate::ast::Call;
use crate::{Problem, Span, Type};

impl Checker<'_> {
    #[inline(never)]
    /// Returns the constructed type; the arguments have been checked.
    pub(super) fn construct(&mut self, call: &mut Call, span: Span) -> Option<Type> {
        let is_struct = self.structs.contains_key(&call.name);
        let of = if is_struct { Type::Struct(call.name.clone()) } else { Type::named(&call.name)? };
        if !call.sizes.is_empty() {
            return self.construct_array(of, call, span);
        }
        match of {
            Type::Struct(_) => self.construct_struct(call, span),
            Type::Void | Type::Opaque(_) | Type::Array(..) => {
                self.error(span, "constructor", format!("cannot construct a value of type `{of}`"));
                return None;
            }
            Type::Scalar(_) | Type::Vector(..) | Type::Matrix { .. } => self.construct_number(&of, call, span),
        }
        Some(of)
    }

    fn construct_array(&mut self, of: Type, call: &mut Call, span: Span) -> Option<Type> {
        let mut ty = self.sized(of, &mut call.sizes)?;
        let Type::Array(of, count) = &mut ty else { return None };
        let found = call.args.len() as u32;
        let wanted = *count.get_or_insert(found);
        if wanted != found {
            self.error(span, "constructor", format!("this array has {wanted} elements, found {found}"));
        }
        let of = (**of).clone();
        for arg in &call.args {
            self.convert(arg, Some(&of), "this element");
        }
        self.check_type(&ty, span);
        Some(ty)
    }

    fn construct_struct(&mut self, call: &Call, span: Span) {
        let Some(info) = self.structs.get(&call.name).cloned() else { return };
        if info.members.len() != call.args.len() {
            let (wanted, found) = (info.members.len(), call.args.len());
            self.error(span, "constructor", format!("`{}` has {wanted} members, found {found}", call.name));
            return;
        }
        for (arg, (_, ty)) in call.args.iter().zip(&info.members) {
            self.convert(arg, ty.as_ref(), "this member");
        }
    }

    fn construct_number(&mut self, of: &Type, call: &Call, span: Span) {
        let Some(wanted) = of.components() else { return };
        if call.args.is_empty() {
            self.error(span, "constructor", format!("`{of}()` needs an argument"));
            return;
        }
        let mut found = 0;
        for (index, arg) in call.args.iter().enumerate() {
            let Some(ty) = &arg.ty else { return };
            let Some(count) = ty.components() else {
                self.error(arg.span, "constructor", format!("cannot construct `{of}` from `{ty}`"));
                return;
            };
            let is_matrix = matches!(ty, Type::Matrix { .. });
            if is_matrix && matches!(of, Type::Matrix { .. }) {
                if call.args.len() > 1 {
                    self.error(arg.span, "constructor", "a matrix constructed from a matrix takes no other arguments");
                }
                return;
            }
            if found >= wanted {
                let message = format!(
                    "too many arguments: `{of}` has {wanted} components, which are filled before argument {}",
                    index + 1
                );
                self.error(arg.span, "constructor", message);
                return;
            }
            found += count;
        }
        if found == 1 && call.args.len() == 1 {
            return;
        }
        if found < wanted {
            let message = format!("`{of}` needs {wanted} components, found {found}");
            let mut problem = Problem::error(span, "constructor", message);
            if found == 3 && wanted == 4 {
                problem = problem.with_help("add a fourth component, such as `1.0`");
            }
            self.problems.push(problem);
        } else if found > wanted && matches!(of, Type::Matrix { .. }) {
            let message = format!("`{of}` needs {wanted} components, found {found}");
            self.error(span, "constructor", message);
        }
    }
}
