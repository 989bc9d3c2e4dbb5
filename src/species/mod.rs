//! What the drawing does not say: a species' parameters, materials, blade forms and the heart of its flowers.
