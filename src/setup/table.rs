//! The register table.
