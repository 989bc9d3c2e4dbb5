//! Finished models to files: one trait, one file per format.
