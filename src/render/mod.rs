//! Pictures of models through wgpu, offscreen or in a window.
