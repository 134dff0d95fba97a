#include "twin/onset/running_envelopes.h"
#include <algorithm>

namespace mill::twin {
RunningEnvelopes::RunningEnvelopes(const double rate, const Eigen::Index channels,
                                   const Eigen::VectorXd &frequency)
    : sample_rate(rate)
{
  for (const double f : frequency)
    filters.push_back(envelope_filter(rate, f));
  const EnvelopeFilter shape = envelope_filter(rate, 0);
  const Eigen::Index n = shape.real.size(), m = frequency.size();
  taps.resize(n, 2 * m);
  for (Eigen::Index i = 0; i < m; ++i) {
    taps.col(2 * i)     = filters[std::size_t(i)].real;
    taps.col(2 * i + 1) = filters[std::size_t(i)].imag;
  }
  buffer.resize(2 * n + 16 * shape.step, channels);
}

double RunningEnvelopes::rate() const
{
  return filters.empty() ? 0 : sample_rate / double(filters[0].step);
}

void RunningEnvelopes::restart()
{
  begin = end = 0;
  number      = -1;
}

void RunningEnvelopes::take(const std::int64_t first, const Eigen::MatrixXd &samples, const Value &value)
{
  if (filters.empty() || buffer.cols() == 0)
    return;
  if (number >= 0 && number + (end - begin) != first)
    restart();
  if (number < 0)
    number = first;
  const Eigen::Index n = taps.rows(), step = filters[0].step, m = Eigen::Index(filters.size());
  Eigen::MatrixXd mixed(2 * m, buffer.cols());
  Eigen::MatrixXcd z(m, buffer.cols());
  for (Eigen::Index done = 0; done < samples.rows();) {
    if (end == buffer.rows()) {
      const Eigen::MatrixXd rest  = buffer.middleRows(begin, end - begin);
      buffer.topRows(rest.rows()) = rest;
      begin                       = 0;
      end                         = rest.rows();
    }
    const Eigen::Index now      = std::min(samples.rows() - done, buffer.rows() - end);
    buffer.middleRows(end, now) = samples.middleRows(done, now);
    end += now;
    done += now;
    for (; end - begin >= n; begin += step, number += step) {
      for (Eigen::Index c = 0; c < z.cols(); ++c)  // one product for all would copy the taps at every value
        mixed.col(c).noalias() = taps.transpose() * buffer.col(c).segment(begin, n);
      for (Eigen::Index i = 0; i < m; ++i) {
        const std::complex<double> back = filters[std::size_t(i)].turned_back(number);
        for (Eigen::Index c = 0; c < z.cols(); ++c)
          z(i, c) = std::complex<double>(mixed(2 * i, c), mixed(2 * i + 1, c)) * back;
      }
      value(double(number + n / 2) / sample_rate, z);
    }
  }
}
}  // namespace mill::twin
