//! Tables of keys. A key is declared once, by [`table!`]: its name and its field in the scene, its
//! meaning, default and kind. Reader, writer, documents and tests walk over the declarations.

use super::error::SceneError;
use super::field::{Field, Fields};
use super::kind::{Key, Kind};
use super::value::Value;
use super::writer::Writer;

/// A part of a scene that is a table of the file, or some keys of one. Its default is what an empty
/// table means.
pub(super) trait Table: Default {
    /// The keys, with the defaults of `default`.
    fn keys(default: &Self) -> Vec<Key>;

    /// What the fields say; `default` counts where they say nothing.
    fn read(fields: &Fields<'_>, default: Self) -> Result<Self, SceneError>;

    fn write(&self, out: &mut Writer);
}

/// A part of a scene whose keys are declared elsewhere, by a struct that it is made of and makes.
pub(super) trait Declared: Clone + From<Self::By> {
    type By: Table + From<Self>;
}

impl<T: Declared + Default> Table for T {
    fn keys(default: &Self) -> Vec<Key> {
        T::By::keys(&default.clone().into())
    }

    fn read(fields: &Fields<'_>, default: Self) -> Result<Self, SceneError> {
        T::By::read(fields, default.into()).map(Self::from)
    }

    fn write(&self, out: &mut Writer) {
        T::By::from(self.clone()).write(out);
    }
}

/// The declaration of a key that does not depend on its type.
pub(super) struct Declaration {
    pub(super) name: &'static str,
    /// The lines of its documentation; the first paragraph is for users, too.
    pub(super) docs: &'static [&'static str],
    pub(super) kind: Kind,
}

impl Declaration {
    /// What the key means: the first paragraph without its full stop.
    fn meaning(&self) -> String {
        let lines = self.docs.iter().map(|line| line.trim()).take_while(|line| !line.is_empty());
        let text = lines.collect::<Vec<_>>().join(" ");
        text.strip_suffix('.').unwrap_or(&text).to_owned()
    }

    pub(super) fn key(self, default: &impl Value) -> Key {
        let (meaning, default) = (self.meaning(), default.write(&self.kind));
        let default = (!default.is_empty()).then_some(default);
        Key { name: self.name, meaning, kind: self.kind, default }
    }

    pub(super) fn read<T: Value>(&self, fields: &Fields<'_>, default: T) -> Result<T, SceneError> {
        fields.get(self.name).map_or(Ok(default), |field| T::read(&field, &self.kind))
    }

    pub(super) fn write(&self, value: &impl Value, out: &mut Writer) {
        let value = value.write(&self.kind);
        let left_out = if value.is_empty() { &format!("{} is left out. ", self.name) } else { "" };
        out.comment(&format!("{left_out}{}. Takes {}.", self.meaning(), self.kind.expected()));
        if !value.is_empty() {
            out.key(self.name, &value);
        }
    }
}

/// The keys of a table as it is by default.
pub(super) fn keys<T: Table>() -> Vec<Key> {
    T::keys(&T::default())
}

/// The names of a table's keys.
pub(super) fn names<T: Table>() -> Vec<&'static str> {
    keys::<T>().iter().map(|key| key.name).collect()
}

/// The keys of a form that is not the usual one: leaving them out means the other.
pub(super) fn keys_of_other_form<T: Table>() -> Vec<Key> {
    keys::<T>().into_iter().map(|key| Key { default: None, ..key }).collect()
}

/// The fields of a table that has no other keys than `T`.
pub(super) fn open<'a, T: Table>(field: &Field<'a>) -> Result<Fields<'a>, SceneError> {
    let fields = field.open()?;
    fields.check_keys(&names::<T>(), |_| false)?;
    Ok(fields)
}

/// A table on one line.
pub(super) fn braces(table: &impl Table) -> String {
    let mut out = Writer::default();
    table.write(&mut out);
    format!("{{ {} }}", out.finish().trim_end().replace('\n', ", "))
}

/// Declares a part of the scene and its keys:
///
/// ```text
/// table! {
///     /// Light.
///     pub struct Light {
///         /// Share of the light that comes from everywhere.
///         ambient: f64 = 0.3, Kind::Number(0.0..=1.0);
///     }
/// }
/// ```
///
/// gives the struct, its `Default`, and the key `ambient` with this meaning, default and kind. A
/// field without a kind is a [`Table`] itself, whose keys stand among the others.
macro_rules! table {
    ($(#[$meta:meta])* $vis:vis struct $table:ident {
        $( $(#[doc = $doc:literal])+ $name:ident: $type:ty = $default:expr $(, $kind:expr)?; )+
    }) => {
        $(#[$meta])*
        $vis struct $table {
            $( $(#[doc = $doc])+ pub $name: $type, )+
        }

        impl Default for $table {
            fn default() -> Self {
                Self { $( $name: $default, )+ }
            }
        }

        impl $crate::scene::table::Table for $table {
            fn keys(default: &Self) -> Vec<$crate::scene::kind::Key> {
                [$( $crate::scene::table::table!(
                    @keys $name [$($doc)+] (&default.$name) $($kind)?
                ), )+].concat()
            }

            fn read(
                fields: &$crate::scene::field::Fields<'_>,
                default: Self,
            ) -> Result<Self, $crate::scene::error::SceneError> {
                Ok(Self { $( $name: $crate::scene::table::table!(
                    @read $name [$($doc)+] (fields, default.$name) $($kind)?
                ), )+ })
            }

            fn write(&self, out: &mut $crate::scene::writer::Writer) {
                $( $crate::scene::table::table!(
                    @write $name [$($doc)+] (&self.$name, out) $($kind)?
                ); )+
            }
        }

        impl $crate::scene::value::Value for $table {
            fn read(
                field: &$crate::scene::field::Field<'_>,
                _: &$crate::scene::kind::Kind,
            ) -> Result<Self, $crate::scene::error::SceneError> {
                let fields = $crate::scene::table::open::<Self>(field)?;
                $crate::scene::table::Table::read(&fields, Self::default())
            }

            fn write(&self, _: &$crate::scene::kind::Kind) -> String {
                $crate::scene::table::braces(self)
            }
        }
    };
    (@declare $name:ident [$($doc:literal)+] $kind:expr) => {
        $crate::scene::table::Declaration {
            name: stringify!($name),
            docs: &[$($doc),+],
            kind: $kind,
        }
    };
    (@keys $name:ident $docs:tt ($default:expr)) => {
        $crate::scene::table::Table::keys($default)
    };
    (@keys $name:ident $docs:tt ($default:expr) $kind:expr) => {
        vec![$crate::scene::table::table!(@declare $name $docs $kind).key($default)]
    };
    (@read $name:ident $docs:tt ($fields:expr, $default:expr)) => {
        $crate::scene::table::Table::read($fields, $default)?
    };
    (@read $name:ident $docs:tt ($fields:expr, $default:expr) $kind:expr) => {
        $crate::scene::table::table!(@declare $name $docs $kind).read($fields, $default)?
    };
    (@write $name:ident $docs:tt ($value:expr, $out:expr)) => {
        $crate::scene::table::Table::write($value, $out)
    };
    (@write $name:ident $docs:tt ($value:expr, $out:expr) $kind:expr) => {
        $crate::scene::table::table!(@declare $name $docs $kind).write($value, $out)
    };
}

/// Declares an enum whose variants are words in the file.
macro_rules! words {
    ($(#[$meta:meta])* $vis:vis enum $name:ident {
        $( $(#[$doc:meta])* $variant:ident = $word:literal, )+
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        $vis enum $name {
            $( $(#[$doc])* $variant, )+
        }

        impl $crate::scene::words::Words for $name {
            const WORDS: &'static [(&'static str, Self)] = &[$( ($word, Self::$variant) ),+];
        }
    };
}

pub(super) use {table, words};
