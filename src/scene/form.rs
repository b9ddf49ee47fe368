//! Two ways to say the same thing in one table.

use super::error::{Place, SceneError, list};
use super::field::{Field, Fields};
use super::table::{Table, names};

/// Which of two ways to say the same thing a table uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// No key of either is given.
    Neither,
    First,
    Second,
}

/// Chooses between two ways to say the same thing; both at once are an error, but a `--set`
/// option replaces what the file says.
pub(super) fn one_form<First: Table, Second: Table>(
    table: &Fields<'_>,
) -> Result<Form, SceneError> {
    let (first, second) = (names::<First>(), names::<Second>());
    let given = |keys: &[&str], set: bool| {
        keys.iter().filter_map(|key| table.get(key)).find(|field| field.is_set() == set)
    };
    // The options among themselves come first, then the file by itself.
    for set in [true, false] {
        match (given(&first, set), given(&second, set)) {
            (Some(a), Some(b)) => {
                let remedy = format!("keep either {}, or {}", list(first), list(second));
                return Err(both(&a, &b, remedy));
            }
            (Some(_), None) => return Ok(Form::First),
            (None, Some(_)) => return Ok(Form::Second),
            (None, None) => {}
        }
    }
    Ok(Form::Neither)
}

fn both(a: &Field<'_>, b: &Field<'_>, remedy: String) -> SceneError {
    let offset = |field: &Field<'_>| match field.place() {
        Place::File { line, column, .. } => (line, column),
        Place::Set { .. } => (0, 0),
    };
    let (earlier, later) = if offset(b) >= offset(a) { (a, b) } else { (b, a) };
    SceneError::Field {
        place: later.place(),
        field: later.path.clone(),
        reason: format!(
            "this and `{}` ({}) say the same thing twice",
            earlier.path,
            earlier.place().brief()
        ),
        remedy,
    }
}
