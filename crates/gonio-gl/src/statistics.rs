//! Counters of the GPU: invocations of the vertex and the fragment shader.

use crate::driver::DriverInfo;
use crate::objects::Query;
use crate::{Gl, GlError};

/// ARB_pipeline_statistics_query
const VERTEX_SHADER_INVOCATIONS: u32 = 0x82F0;
/// ARB_pipeline_statistics_query
const FRAGMENT_SHADER_INVOCATIONS: u32 = 0x82F4;

/// Counts of one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GpuStatistics {
    /// Vertex shader invocations; `None` where the driver cannot count them.
    pub vertices: Option<u64>,
    /// Fragment shader invocations, whole 2x2 blocks included; `None` where the driver cannot count.
    pub fragments: Option<u64>,
    /// Draw calls.
    pub draw_calls: u32,
}

/// Counters that run.
pub struct StatisticsQueries {
    queries: Option<[Query; 2]>,
}

/// Counters that have stopped; reading them waits for the GPU.
pub struct StoppedQueries {
    gl: Gl,
    queries: Option<[Query; 2]>,
    draw_calls: u32,
}

impl StatisticsQueries {
    /// Begins to count, where the driver can.
    pub fn begin(gl: &Gl, info: &DriverInfo) -> Result<Self, GlError> {
        if !info.pipeline_statistics {
            return Ok(StatisticsQueries { queries: None });
        }
        let queries = [Query::new(gl)?, Query::new(gl)?];
        gl.begin_query(VERTEX_SHADER_INVOCATIONS, queries[0].handle());
        gl.begin_query(FRAGMENT_SHADER_INVOCATIONS, queries[1].handle());
        Ok(StatisticsQueries { queries: Some(queries) })
    }

    /// Ends counting.
    pub fn end(self, gl: &Gl, draw_calls: u32) -> StoppedQueries {
        if self.queries.is_some() {
            gl.end_query(FRAGMENT_SHADER_INVOCATIONS);
            gl.end_query(VERTEX_SHADER_INVOCATIONS);
        }
        StoppedQueries { gl: gl.clone(), queries: self.queries, draw_calls }
    }
}

impl StoppedQueries {
    /// Reads the counters, which waits for the GPU.
    pub fn read(&self) -> GpuStatistics {
        let count = |query: &Query| u64::from(self.gl.get_query_parameter_u32(query.handle(), glow::QUERY_RESULT));
        GpuStatistics {
            vertices: self.queries.as_ref().map(|q| count(&q[0])),
            fragments: self.queries.as_ref().map(|q| count(&q[1])),
            draw_calls: self.draw_calls,
        }
    }
}
