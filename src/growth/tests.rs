//! Tests of whole plants.
