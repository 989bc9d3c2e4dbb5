//! Blade or branch? A support vector machine on three features (002 §4.1).
