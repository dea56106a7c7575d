//! How values lie in registers: scalars side by side, matrices by columns, arrays and structs member by member.

use gonio_glsl::{Checked, Scalar, StructInfo, Type};
use std::collections::HashMap;

/// Most scalars of one value, four times what `gonio_glsl` accepts.
const MOST_SCALARS: u32 = 65_536;
/// Most names that one variable is split into.
const MOST_LEAVES: usize = 4096;
/// Elements of built-in arrays without a size, such as `gl_TexCoord`.
pub(crate) const OPEN_ARRAY: u32 = 8;

/// The structs of a shader.
#[derive(Debug, Clone, Default)]
pub(crate) struct Layouts {
    structs: HashMap<String, Vec<(String, Option<Type>)>>,
}

/// A part of a variable that OpenGL identifies by a name.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NamedPart {
    pub name: String,
    /// The basic type, without the array.
    pub ty: Type,
    /// Elements of an array of basic values; 1 if it is not an array.
    pub count: u32,
    /// The first scalar within the variable.
    pub offset: u32,
}

impl Layouts {
    pub fn new(checked: &Checked) -> Self {
        let single = |ty: &Option<Type>| ty.as_ref().map(in_single_precision);
        let members =
            |all: &[(String, Option<Type>)]| all.iter().map(|(name, ty)| (name.clone(), single(ty))).collect();
        let mut structs: HashMap<_, _> =
            checked.interface.structs.iter().map(|s| (s.name.clone(), members(&s.members))).collect();
        for block in &checked.interface.blocks {
            let members = block.members.iter().map(|m| (m.name.clone(), single(&m.ty))).collect();
            // The name that the checker gives to the type of an instance.
            structs.insert(format!("{} (block)", block.name), members);
        }
        Self { structs }
    }

    /// Adds a struct that the shader does not declare itself.
    pub fn add(&mut self, info: &StructInfo) {
        self.structs.entry(info.name.clone()).or_insert_with(|| info.members.clone());
    }

    /// Returns the number of scalars; `None` for types without a layout here.
    pub fn size(&self, ty: &Type) -> Option<u32> {
        self.size_at(ty, 0)
    }

    fn size_at(&self, ty: &Type, nested: u32) -> Option<u32> {
        if nested > 80 {
            return None;
        }
        let size = match ty {
            Type::Void => 0,
            Type::Opaque(_) => 1,
            Type::Struct(name) => {
                let mut size = 0_u32;
                for (_, ty) in self.structs.get(name)? {
                    size = size.checked_add(self.size_at(ty.as_ref()?, nested + 1)?)?;
                }
                size
            }
            Type::Array(of, count) => self.size_at(of, nested + 1)?.checked_mul(count.unwrap_or(OPEN_ARRAY))?,
            _ => ty.components()?,
        };
        (size <= MOST_SCALARS).then_some(size)
    }

    /// Returns a member's offset and type.
    pub fn member(&self, of: &str, name: &str) -> Option<(u32, Type)> {
        let mut offset = 0;
        for (member, ty) in self.structs.get(of)? {
            let ty = ty.as_ref()?;
            if member == name {
                return Some((offset, ty.clone()));
            }
            offset += self.size(ty)?;
        }
        None
    }

    /// Returns the types of a struct's members.
    pub fn members(&self, of: &str) -> Vec<Type> {
        self.structs.get(of).into_iter().flatten().filter_map(|(_, ty)| ty.clone()).collect()
    }

    /// Splits a variable into the names of `glGetUniformLocation` (OpenGL 4.6, section 7.3.1).
    pub fn parts(&self, name: &str, ty: &Type) -> Vec<NamedPart> {
        let mut found = Vec::new();
        self.split(name, ty, 0, 0, &mut found);
        found
    }

    fn split(&self, name: &str, ty: &Type, offset: u32, nested: u32, found: &mut Vec<NamedPart>) {
        if found.len() >= MOST_LEAVES || nested > 80 {
            return;
        }
        match ty {
            Type::Struct(of) => {
                let mut at = offset;
                for (member, ty) in self.structs.get(of).into_iter().flatten() {
                    let Some((ty, size)) = ty.as_ref().and_then(|ty| Some((ty, self.size(ty)?))) else { return };
                    self.split(&format!("{name}.{member}"), ty, at, nested + 1, found);
                    at += size;
                }
            }
            Type::Array(of, count) if matches!(**of, Type::Struct(_) | Type::Array(..)) => {
                let Some(size) = self.size(of) else { return };
                for index in 0..count.unwrap_or(OPEN_ARRAY) {
                    if found.len() >= MOST_LEAVES {
                        return;
                    }
                    self.split(&format!("{name}[{index}]"), of, offset + index * size, nested + 1, found);
                }
            }
            Type::Array(of, count) => {
                let count = count.unwrap_or(OPEN_ARRAY);
                found.push(NamedPart { name: name.into(), ty: (**of).clone(), count, offset });
            }
            _ => found.push(NamedPart { name: name.into(), ty: ty.clone(), count: 1, offset }),
        }
    }
}

/// The type with `float` in place of `double`: the machine computes in 32 bits, and a `double` has the precision of a float.
pub(crate) fn in_single_precision(ty: &Type) -> Type {
    match ty {
        Type::Array(of, count) => Type::Array(in_single_precision(of).into(), *count),
        _ if ty.scalar() == Some(Scalar::Double) => ty.with_scalar(Scalar::Float),
        _ => ty.clone(),
    }
}

/// The component type as the machine computes with it; samplers are numbers of textures.
pub(crate) fn scalar_of(ty: &Type) -> Scalar {
    match ty {
        Type::Opaque(_) => Scalar::Int,
        Type::Array(of, _) => scalar_of(of),
        _ => ty.scalar().unwrap_or(Scalar::UInt),
    }
}
