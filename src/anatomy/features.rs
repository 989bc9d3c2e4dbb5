//! Stroke features for the classifier (002 §4.1).
